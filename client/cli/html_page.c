/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "html_page.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "json_writer.h"
#include "output_file.h"

/* The page, with a zero at its end; MARK stands where its data come. */
extern const unsigned char page_template[];
static const char MARK[] = "@DATA@";

/* The program's standard output where the page goes there. */
static int page_output = -1;

const char *html_page_file(const char *text, struct argp_state *state)
{
    if (strcmp(text, "-") != 0) {
        output_file_check("html", text, state);
        return text;
    }
    fflush(stdout);
    if (page_output < 0 &&
        ((page_output = dup(STDOUT_FILENO)) < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0))
        argp_failure(state, EXIT_USAGE, errno, "--html: standard output cannot be written");
    return text;
}

static int write_page(const char *file, const char *text, size_t size)
{
    if (strcmp(file, "-") != 0)
        return output_file_write("html", file, text, size);
    while (size > 0) {
        ssize_t written = write(page_output, text, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0) {
            complain("--html: standard output: could not be written: %s", strerror(errno));
            return EXIT_FAILURE;
        }
        text += written;
        size -= (size_t)written;
    }
    return EXIT_ANSWERED;
}

/* JSON within the page's script element, which none of its signs may end. */
static void put_json(FILE *out, const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (text[i] == '<')
            fputs("\\u003c", out);
        else
            fputc(text[i], out);
}

/* The command line, so that a shell reads it again; to be freed. NULL: out of memory. */
static char *command_line(char *const *words)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (size_t i = 0; words && words[i]; i++) {
        const char *word = i == 0 ? "percuss" : words[i];
        bool plain = *word && !word[strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVW"
                                                 "XYZ0123456789-_./:=+,%@")];
        fputs(i ? " " : "", out);
        if (plain) {
            fputs(word, out);
            continue;
        }
        fputc('\'', out);
        for (; *word; word++)
            fputs(*word == '\'' ? "'\\''" : (char[]){*word, '\0'}, out);
        fputc('\'', out);
    }
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

/* More than can be seen, and half as large. */
enum { DIGITS = 7 };

void html_page_put_numbers(FILE *out, const double *values, size_t count)
{
    fputc('[', out);
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            fprintf(out, "%s%.*g", i ? "," : "", DIGITS, values[i]);
        else
            fprintf(out, "%snull", i ? "," : "");
    fputc(']', out);
}

/* The data of the page as text; to be freed. NULL: out of memory. */
static char *describe(json_t *data, const struct common *common)
{
    char *command = command_line(common->words), *text = NULL;
    json_t *words = command ? json_text_or_null(command) : NULL;
    if (data && json_object_set_new(data, "command", words) == 0)
        text = json_text(data);
    json_decref(data);
    free(command);
    return text;
}

int html_page_write(const char *file, json_t *data, html_page_more *more, const void *context,
                    const struct common *common)
{
    const char *page = (const char *)page_template, *mark = strstr(page, MARK);
    char *text = NULL;
    size_t size = 0;
    char *description = describe(data, common);
    FILE *out = description ? open_memstream(&text, &size) : NULL;
    if (!out) {
        free(description);
        return complain_memory();
    }
    fwrite(page, 1, (size_t)(mark - page), out);
    /* other members come before its end */
    put_json(out, description, strlen(description) - 1);
    if (more)
        more(out, context);
    fprintf(out, "}%s", mark + strlen(MARK));
    bool good = !ferror(out);
    good = fclose(out) == 0 && good;
    free(description);
    int code = good ? write_page(file, text, size) : complain_memory();
    free(text);
    return code;
}

json_t *html_page_numbers(const void *first, size_t stride, size_t count)
{
    json_t *array = json_array();
    bool good = array;
    for (size_t i = 0; good && i < count; i++)
        good = json_array_append_new(
                   array, json_number(*(const double *)((const char *)first + i * stride))) == 0;
    if (good)
        return array;
    json_decref(array);
    return NULL;
}
