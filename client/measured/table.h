/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A file of columns of numbers, as rigs write them. */
#ifndef PERCUSS_MEASURED_TABLE_H
#define PERCUSS_MEASURED_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "column.h"

/* A line with something in it, and its number in the file. */
struct text_line {
    char *text;
    size_t number;
};

struct text_lines {
    size_t count;
    struct text_line *list;
};

struct cells {
    char *text;
    size_t all, filled; /* as of divide_line */
    char **list;        /* [all] */
};

/* Which columns a file may have, and the user's description of them. */
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

struct table {
    char *text; /* holds everything below */
    struct text_lines lines;
    struct layout layout;
    size_t rows;
    char **cells;     /* [rows][source->kind_count]; "" where there is none */
    size_t *numbers;  /* [rows], of lines, for messages */
    char mark;        /* the decimal mark of the first number that has one; 0: none yet */
    size_t mark_line; /* where that was */
    struct unusual {
        size_t count, line; /* the first one's */
        double value;
    } unusual[COLUMN_KINDS];
};

/* Reads a file; empty lines and lines that begin with # are skipped. Faulty lines are named and
 * skipped. Notes columns that are not read, and lines before the headings. False: it cannot be
 * read. Release with table_free. */
bool table_read(const struct table_source *source, struct table *table,
                struct measured_remarks *remarks);

void table_free(struct table *table);

/* Whether the file has such a column. */
bool table_has(const struct table *table, size_t kind);

const char *table_cell(const struct table *table, size_t row, size_t kind);

/* The cell in SI units, NAN where nothing is in it or the file has no such column. False, with the
 * fault, for a text that is no number or an impossible one. */
bool table_number(struct table *table, size_t row, size_t kind, double *number,
                  struct measured_remarks *remarks);

/* Remembers a number that is possible but improbable; table_number does, too. */
void table_look(struct table *table, size_t row, size_t kind, double number);

/* Notes the numbers remembered that are possible but improbable: of each column the first one,
 * with its line, and how many others there are. */
void table_note_unusual(const struct table *table, struct measured_remarks *remarks);

/* Writes "'a', 'b' and 3 more" of the columns that are not read, or of all of them; returns how
 * many there are. */
size_t layout_list(const struct layout *layout, bool all, char *text, size_t size);

/* Rows that are left out for one reason. */
enum { LEFT_OUT_NAMED = 10 };
struct left_out {
    size_t count;
    size_t lines[LEFT_OUT_NAMED];
};
void left_out_add(struct left_out *left, size_t line);

/* Appends "; no speed in lines 4, 7 and 3 more" to the text, without the semicolon where it is
 * empty, and nothing where none was left out. */
void left_out_tell(const struct left_out *left, const char *reason, char *text, size_t size);

#endif
