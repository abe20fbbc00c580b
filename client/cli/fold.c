/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fold.h"

#include <math.h>
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

static size_t terminal_width(int file)
{
    struct winsize size = {0};
    const char *text = getenv("COLUMNS");
    if (!isatty(file))
        return 0;
    int given = text ? atoi(text) : 0;
    if (given <= 0 && ioctl(file, TIOCGWINSZ, &size) == 0)
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
    /* blanks that would fill a line of their own, or end one, say nothing */
    const size_t begin = strspn(line, " ");
    while (columns > 0 && length > columns && length > begin && line[length - 1] == ' ')
        length--;
    if (columns > 0 && length > columns && begin >= columns && begin < length) {
        line += begin - INDENT;
        length -= begin - INDENT;
    }
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
    columns = terminal_width(STDOUT_FILENO);
    FILE *folded =
        columns ? fopencookie(NULL, "w", (cookie_io_functions_t){.write = write_folded}) : NULL;
    if (!folded)
        return;
    setvbuf(folded, NULL, _IOLBF, BUFSIZ);
    stdout = folded;
}

size_t fold_width(void)
{
    return columns;
}

void fold_help(void)
{
    enum { ARGP_WIDTH = 79 };
    char format[128];
    const size_t width = terminal_width(STDOUT_FILENO);
    if (width == 0 || width > ARGP_WIDTH)
        return;
    /* descriptions begin at a third of the width, behind short options or below long ones; argp
     * keeps a column free */
    snprintf(format, sizeof format,
             "rmargin=%zu,short-opt-col=1,long-opt-col=3,doc-opt-col=1,opt-doc-col=%zu,"
             "header-col=1,usage-indent=4",
             width, width / 3);
    setenv("ARGP_HELP_FMT", format, 0);
}

void fold_bar(double share, const char *rest)
{
    enum { WIDEST = 40, LEAST = 4 };
    static const char bar[WIDEST + 1] = "########################################";
    const size_t width = terminal_width(STDERR_FILENO), taken = strlen(rest) + sizeof "[]";
    const size_t room = width > taken + LEAST ? width - taken : LEAST;
    const int wide = width == 0 || room > WIDEST ? WIDEST : (int)room;
    fprintf(stderr, "[%-*.*s]%s", wide, (int)(wide * fmin(fmax(share, 0.0), 1.0)), bar, rest);
}

void fold_end(void)
{
    fflush(stdout);
    columns = 0;
    put_unfinished();
}
