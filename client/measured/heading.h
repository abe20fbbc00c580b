/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the cells of a line of headings, and of units, say of a file's columns. */
#ifndef PERCUSS_MEASURED_HEADING_H
#define PERCUSS_MEASURED_HEADING_H

#include "layout.h"

/* What the file calls a column of that kind. */
const char *heading_wanted(const struct table_source *source, size_t kind);

/* The kind that a heading names, or -1. *whole: by all of its text, not by what stands before a
 * unit. */
int heading_kind(const struct table_source *source, const char *heading, bool *whole);

/* How many columns the cells name. */
size_t heading_matches(const struct table_source *source, const struct cells *cells);

/* The column of each kind that its number was given for, counted from 0; -1: not chosen so. */
int heading_number(const struct table_source *source, size_t kind);

/* Fills layout->place and layout->unit by layout->titles. False: two columns for one, none for one
 * that was asked for, or a unit that is none. */
bool heading_take(struct layout *layout, struct measured_remarks *remarks);

/* Whether a line below the headings, divided, is one of units: it has no number in any column. */
bool heading_units_stand(const struct layout *layout, const struct cells *cells);

/* Takes them. False: one is none, or is not what the heading says. */
bool heading_take_units(struct layout *layout, const struct cells *cells, size_t line,
                        struct measured_remarks *remarks);

#endif
