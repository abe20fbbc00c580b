/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fold.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* A narrower terminal has no room for tables; a line's continuation is indented by so much. */
enum { NARROWEST = 30, INDENT = 4 };

/* 0: lines are left as they are */
static size_t columns;

static size_t terminal_width(void)
{
    struct winsize size = {0};
    const char *text = getenv("COLUMNS");
    if (!isatty(STDOUT_FILENO))
        return 0;
    int given = text ? atoi(text) : 0;
    if (given <= 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0)
        given = size.ws_col;
    return given >= NARROWEST ? (size_t)given : 0;
}

static bool has_columns(const char *text, size_t length)
{
    for (size_t i = 1; i < length; i++)
        if (text[i - 1] == ' ' && text[i] == ' ')
            return true;
    return false;
}

size_t fold_place(const char *line, size_t length, size_t width, size_t *next, size_t *indent)
{
    size_t word = 0, column = 0;
    size_t begin = strspn(line, " ");
    *indent = INDENT;
    /* the last end of a word that fits, and the last one with two blanks behind: of a column */
    for (size_t i = begin + 1; i <= width && i < length; i++) {
        if (line[i] != ' ' || line[i - 1] == ' ')
            continue;
        word = i;
        if (i + 1 < length && line[i + 1] == ' ')
            column = i;
    }
    /* a text at the end goes on below its beginning, if it has room there */
    size_t text = column;
    while (text < length && line[text] == ' ')
        text++;
    size_t place = word;
    if (column > 0 && word > text && 4 * text <= 3 * width &&
        !has_columns(line + text, length - text))
        *indent = text;
    else if (2 * column >= width)
        place = column;
    *next = place;
    while (*next < length && line[*next] == ' ')
        (*next)++;
    return place > 0 && *next < length ? place : length;
}

/* One line without its end. */
static bool put_line(const char *line, size_t length)
{
    size_t stands_in = 0, next, indent;
    bool good = true;
    while (good && columns > 0 && length > columns - stands_in) {
        size_t place = fold_place(line, length, columns - stands_in, &next, &indent);
        if (place == length)
            break;
        good = dprintf(STDOUT_FILENO, "%*s%.*s\n", (int)stands_in, "", (int)place, line) >= 0;
        line += next;
        length -= next;
        stands_in = stands_in ? stands_in : indent;
    }
    return good && dprintf(STDOUT_FILENO, "%*s%.*s\n", (int)stands_in, "", (int)length, line) >= 0;
}

/* A line that has not come to its end. */
static struct {
    char text[4096];
    size_t length;
} unfinished;

static bool put_unfinished(void)
{
    size_t length = unfinished.length;
    unfinished.length = 0;
    return length == 0 || dprintf(STDOUT_FILENO, "%.*s", (int)length, unfinished.text) >= 0;
}

static ssize_t write_folded(void *cookie, const char *text, size_t size)
{
    bool good = true;
    (void)cookie;
    for (size_t i = 0; i < size && good; i++) {
        if (text[i] != '\n') {
            unfinished.text[unfinished.length++] = text[i];
            /* so long a line is no table's */
            if (unfinished.length == sizeof unfinished.text)
                good = put_unfinished();
            continue;
        }
        good = put_line(unfinished.text, unfinished.length);
        unfinished.length = 0;
    }
    return good ? (ssize_t)size : 0;
}

void fold_begin(void)
{
    columns = terminal_width();
    FILE *folded =
        columns ? fopencookie(NULL, "w", (cookie_io_functions_t){.write = write_folded}) : NULL;
    if (!folded)
        return;
    setvbuf(folded, NULL, _IOLBF, BUFSIZ);
    stdout = folded;
}

void fold_end(void)
{
    fflush(stdout);
    columns = 0;
    put_unfinished();
}
