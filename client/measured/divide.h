/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The division of a line into cells, and the reading of a cell. */
#ifndef PERCUSS_MEASURED_DIVIDE_H
#define PERCUSS_MEASURED_DIVIDE_H

#include <stdbool.h>
#include <stddef.h>

/* Separators in the order in which they are tried: a file divided by one of the first has no cells
 * with it. A blank stands for any number of blanks and tabs. */
extern const char DIVIDE_SEPARATORS[]; /* "\t;, " */

/* Divides a line in place into cells without white space or quotes around; doubled quotes inside
 * of quotes are one, and separators there are text. Stores as many as there is room for; returns
 * how many there are up to the last that is not empty, and *all of them. */
size_t divide_line(char *line, char separator, char **cells, size_t room, size_t *all);

/* Whether it stands for a reading that is not there: empty, "-", nan, n/a, #N/A, ... */
bool cell_is_missing(const char *cell);

/* The decimal mark that stands in the cell, '.' or ','; 0: none. */
char cell_mark(const char *cell);

enum { CELL_SIZE = 400 };

/* The number's text with a decimal point, whichever mark it has. False: it is too long, or has both
 * marks. */
bool cell_with_point(const char *cell, char number[CELL_SIZE]);

/* Whether it is a number, with a unit behind it or not. */
bool cell_begins_with_number(const char *cell);

/* Whether two names are the same but for case, blanks, dots, hyphens and underscores. */
bool cell_same_name(const char *one, const char *other);

#endif
