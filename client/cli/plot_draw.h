/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Gnuplot, as a program. */
#ifndef PERCUSS_CLI_PLOT_DRAW_H
#define PERCUSS_CLI_PLOT_DRAW_H

#include <stddef.h>
#include <stdio.h>

/* Runs the script, from its first byte on; the picture that it writes to its standard output, to be
 * freed, or NULL with a complaint that names the file it would have been. */
char *plot_draw(FILE *script, const char *file, size_t *size);

#endif
