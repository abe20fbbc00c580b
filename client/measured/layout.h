/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How a file of columns is laid out: its separator, where its headings stand, which column is what
 * and in which unit. */
#ifndef PERCUSS_MEASURED_LAYOUT_H
#define PERCUSS_MEASURED_LAYOUT_H

#include "cells.h"
#include "column.h"

/* Which columns a file may have, and what the user says of them. */
struct table_source {
    const char *file; /* "-": standard input */
    const struct column_kind *kinds;
    size_t kind_count;            /* up to COLUMN_KINDS */
    const struct column_map *map; /* or NULL */
};

struct layout {
    const struct table_source *source;
    char separator;
    size_t first;            /* index of the line with the first row */
    size_t line;             /* number of the line of headings; 0: there is none */
    struct cells titles;     /* of the columns, as the headings say, or as the first row has them */
    int place[COLUMN_KINDS]; /* column of each kind, or -1 */
    char unit[COLUMN_KINDS][UNIT_SIZE];
};

void layout_free(struct layout *layout);

/* The column's name and place for messages: "speed", "(column 2, 'v [mm/s]')". */
struct layout_place {
    char text[HEADING_SIZE + 40];
};
struct layout_place layout_place(const struct layout *layout, size_t kind);

/* Writes "'a', 'b' and 3 more" of the columns that are not read, or of all of them; returns how
 * many there are. */
size_t layout_list(const struct layout *layout, bool all, char *text, size_t size);

#endif
