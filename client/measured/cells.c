/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "cells.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "divide.h"

static const char BLANKS[] = " \t";

static size_t count_of(const char *text, const char *wanted)
{
    size_t count = 0;
    for (; *text; text++)
        count += strchr(wanted, *text) != NULL;
    return count;
}

bool lines_find(char *text, struct text_lines *lines)
{
    *lines = (struct text_lines){0, calloc(count_of(text, "\n") + 1, sizeof *lines->list)};
    size_t number = 0;
    for (char *next = text; next && lines->list;) {
        char *line = next, *end = strchr(line, '\n');
        next = end ? end + 1 : NULL;
        if (end)
            *end = '\0';
        number++;
        /* separators alone are nothing either: rows that a spreadsheet left empty */
        if (line[strspn(line, " \t;,\f\v")])
            lines->list[lines->count++] = (struct text_line){line, number};
    }
    return lines->list != NULL;
}

bool line_is_comment(const struct text_line *line)
{
    const char *text = line->text + strspn(line->text, BLANKS);
    char cell[16];
    snprintf(cell, sizeof cell, "%.*s", (int)strcspn(text, "\t;,"), text);
    return *text == '#' && !cell_is_missing(cell);
}

bool cells_divide(const struct text_line *line, char separator, struct cells *cells)
{
    const char *text = line->text;
    const char separators[] = {separator, separator == ' ' ? '\t' : '\0', '\0'};
    if (line_is_comment(line)) {
        text += strspn(text, BLANKS) + 1;
        text += strspn(text, separator == '\t' ? " " : BLANKS);
    }
    size_t room = count_of(text, separators) + 1;
    *cells = (struct cells){.text = strdup(text), .list = calloc(room, sizeof *cells->list)};
    if (!cells->text || !cells->list) {
        cells_free(cells);
        return false;
    }
    cells->filled = divide_line(cells->text, separator, cells->list, room, &cells->all);
    return true;
}

void cells_free(struct cells *cells)
{
    free(cells->text);
    free(cells->list);
    *cells = (struct cells){0};
}
