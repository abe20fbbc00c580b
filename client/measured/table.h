/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A file of comma-separated values with a line of column names. */
#ifndef PERCUSS_MEASURED_TABLE_H
#define PERCUSS_MEASURED_TABLE_H

#include <stdbool.h>
#include <stddef.h>

struct measured_fault {
    char text[512];
};

struct table {
    const char *file; /* borrowed */
    char *text;       /* holds everything below */
    size_t columns, rows;
    char **names;  /* [columns] */
    char **cells;  /* [rows][columns], without white space around */
    size_t *lines; /* [rows], for messages */
};

/* Reads a file; empty lines and lines that begin with # are skipped. False with the reason. */
bool table_read(const char *file, struct table *table, struct measured_fault *fault);

void table_free(struct table *table);

/* The column's index, or -1. */
int table_column(const struct table *table, const char *name);

const char *table_cell(const struct table *table, size_t row, int column);

/* The cell as a number, NAN where it is empty, "nan" or the column is -1. False with the reason for
 * anything else. */
bool table_number(const struct table *table, size_t row, int column, double *number,
                  struct measured_fault *fault);

/* Writes a message; returns false. */
bool measured_fail(struct measured_fault *fault, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
