/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Pictures by gnuplot, as PNG or SVG by the file's ending. */
#ifndef PERCUSS_CLI_PLOT_H
#define PERCUSS_CLI_PLOT_H

#include <argp.h>
#include <stdio.h>

/* Ends the process with exit code 2 unless the file's name ends in .png or .svg and it can be
 * written. */
void plot_check(const char *file, struct argp_state *state);

/* A picture under way: write gnuplot commands and data to `script`. */
struct plot {
    FILE *script;
    const char *file;
};

/* Begins a picture of so many pixels. Exit code; complains. */
int plot_begin(struct plot *plot, const char *file, unsigned width, unsigned height);

/* Writes a text as a gnuplot string. */
void plot_text(const struct plot *plot, const char *text);

/* Lets gnuplot draw, and writes the file if it could. Exit code; complains if there is no gnuplot
 * or something fails. */
int plot_end(struct plot *plot);

#endif
