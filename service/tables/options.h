/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The command line of percuss-tables. */
#ifndef PERCUSS_TABLES_OPTIONS_H
#define PERCUSS_TABLES_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "store/table_file.h"

struct options {
    const char *catalogue, *folder;
    const char *bodies; /* folder of what percussd has reduced; "": none */
    const char *a, *b;  /* NULL: every pair that needs a table */
    double speed;       /* m/s */
    size_t resolution;
    bool family;               /* the family of all metals, and nothing else */
    char own[TABLE_PATH_SIZE]; /* the folder where none is given */
};

/* Ends the program for --help, --version and, with exit code 2, wrong usage. */
void options_read(struct options *options, int argc, char **argv);

#endif
