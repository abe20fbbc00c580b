/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lines of a text, and one divided into cells while the line itself stays as it is. */
#ifndef PERCUSS_MEASURED_CELLS_H
#define PERCUSS_MEASURED_CELLS_H

#include <stdbool.h>
#include <stddef.h>

/* A line with something in it, and its number in the file. */
struct text_line {
    char *text;
    size_t number;
};

struct text_lines {
    size_t count;
    struct text_line *list;
};

/* Cuts the text into its lines. False: out of memory. Release with free(lines->list). */
bool lines_find(char *text, struct text_lines *lines);

/* Whether it begins with #, and not with a reading that a spreadsheet has not, as "#N/A". */
bool line_is_comment(const struct text_line *line);

struct cells {
    char *text;
    size_t all, filled; /* as of divide_line */
    char **list;        /* [all] */
};

/* Without the mark of a comment. False: out of memory. Release with cells_free. */
bool cells_divide(const struct text_line *line, char separator, struct cells *cells);

void cells_free(struct cells *cells);

#endif
