/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "html_impact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "body_json.h"
#include "output_file.h"
#include "reply_json.h"
#include "request_json.h"

/* The page, with a zero at its end; MARK stands where the impact comes. */
extern const unsigned char impact_page[];
static const char MARK[] = "@DATA@";

/* JSON within the page's script element, which none of its signs may end. */
static void put_json(FILE *out, const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (text[i] == '<')
            fputs("\\u003c", out);
        else
            fputc(text[i], out);
}

/* Digits of the histories: more than can be seen, and half as large. */
enum { DIGITS = 7 };

static void put_history(FILE *out, const char *name, const double *values, size_t count)
{
    if (!values)
        return;
    fprintf(out, ",\"%s\":[", name);
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            fprintf(out, "%s%.*g", i ? "," : "", DIGITS, values[i]);
        else
            fprintf(out, "%snull", i ? "," : "");
    fputc(']', out);
}

static void put_histories(FILE *out, const struct percuss_trace *trace)
{
    fputs(",\"trace\":[", out);
    for (size_t c = 0; c < trace->contact_count; c++) {
        const struct percuss_contact_trace *t = &trace->contacts[c];
        fprintf(out, "%s{\"contact\":%zu", c ? "," : "", c);
        put_history(out, "time", t->time, t->count);
        put_history(out, "force", t->force, t->count);
        put_history(out, "indentation", t->indentation, t->count);
        put_history(out, "gap", t->gap, t->count);
        put_history(out, "gap_rate", t->gap_rate, t->count);
        put_history(out, "displacement_a", t->displacement_a, t->count);
        put_history(out, "displacement_b", t->displacement_b, t->count);
        put_history(out, "force_tangential_1", t->force_tangential_1, t->count);
        put_history(out, "force_tangential_2", t->force_tangential_2, t->count);
        put_history(out, "slip_1", t->slip_1, t->count);
        put_history(out, "slip_2", t->slip_2, t->count);
        fputc('}', out);
    }
    fputc(']', out);
}

/* Of each body of the request what the catalogue says of it; null: nothing. NULL: out of memory. */
static json_t *bodies_of(const struct percuss_request *request,
                         const struct percuss_body_list *bodies)
{
    json_t *array = json_array();
    bool good = array;
    for (size_t i = 0; good && i < request->body_count; i++) {
        const struct percuss_body *body = percuss_body_find(bodies, request->bodies[i].id);
        good = json_array_append_new(array, body ? body_to_json(body) : json_null()) == 0;
    }
    if (good)
        return array;
    json_decref(array);
    return NULL;
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

/* All but the histories; to be freed. NULL: out of memory. */
static char *describe(const struct impact_run *run, const struct percuss_body_list *bodies,
                      const char *title, const struct common *common)
{
    char *command = command_line(common->words);
    json_t *object = json_pack(
        "{sososososo}", "command", command ? json_text_or_null(command) : NULL, "title",
        title ? json_text_or_null(title) : json_null(), "request", request_to_json(&run->request),
        "reply", reply_to_json(&run->reply), "bodies", bodies_of(&run->request, bodies));
    char *text = json_text(object);
    json_decref(object);
    free(command);
    return text;
}

int html_impact(const char *file, const struct impact_run *run,
                const struct percuss_body_list *bodies, const char *title,
                const struct common *common)
{
    const char *page = (const char *)impact_page, *mark = strstr(page, MARK);
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return complain_memory();
    char *description = describe(run, bodies, title, common);
    fwrite(page, 1, (size_t)(mark - page), out);
    if (description) /* the histories come before its end */
        put_json(out, description, strlen(description) - 1);
    put_histories(out, &run->trace);
    fprintf(out, "}%s", mark + strlen(MARK));
    bool good = description && !ferror(out);
    good = fclose(out) == 0 && good;
    free(description);
    int code = good ? output_file_write("html", file, text, size) : complain_memory();
    free(text);
    return code;
}
