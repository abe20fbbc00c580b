/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lines that are longer than the terminal is wide go on below, broken between words and columns: a
 * terminal breaks them anywhere, numbers too. Bars and helps that fit it. */
#ifndef PERCUSS_CLI_FOLD_H
#define PERCUSS_CLI_FOLD_H

#include <stddef.h>

/* Where to break a line of `length` > `width` characters: how many stay, and in *next where the
 * rest begins, and in *indent by how many blanks. `length`: it has no place for it. */
size_t fold_place(const char *line, size_t length, size_t width, size_t *next, size_t *indent);

/* If standard output is a terminal, folds the output there from now on to COLUMNS, or else to the
 * terminal's width. */
void fold_begin(void);

/* To how many columns it is folded; 0: it is not. */
size_t fold_width(void);

/* Makes argp's help as wide as the terminal that it goes to, if that is narrow; ARGP_HELP_FMT goes
 * before it. */
void fold_help(void);

/* Draws "[####      ]" with a share of 0..1 on standard error, so wide that `rest`, which stands
 * behind it, has room on the terminal, and that behind it. */
void fold_bar(double share, const char *rest);

/* Later output is for programs: it is not folded. */
void fold_end(void);

#endif
