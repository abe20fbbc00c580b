/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lines that are longer than the terminal is wide go on below, broken between words and columns: a
 * terminal breaks them anywhere, numbers too. */
#ifndef PERCUSS_CLI_FOLD_H
#define PERCUSS_CLI_FOLD_H

#include <stddef.h>

/* Where to break a line of `length` > `width` characters: how many stay, and in *next where the
 * rest begins, and in *indent by how many blanks. `length`: it has no place for it. */
size_t fold_place(const char *line, size_t length, size_t width, size_t *next, size_t *indent);

/* If standard output is a terminal, folds the output there from now on to COLUMNS, or else to the
 * terminal's width. */
void fold_begin(void);

/* Later output is for programs: it is not folded. */
void fold_end(void);

#endif
