/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Pictures by gnuplot, as PNG, SVG or PDF by the file's ending; and their data with the script that
 * draws them. */
#ifndef PERCUSS_CLI_PLOT_H
#define PERCUSS_CLI_PLOT_H

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The files to write; NULL: not this one. */
struct plot_output {
    const char *file;   /* the picture */
    const char *folder; /* its data as comma-separated values, and its script */
};

/* Parses --plot and --plot-data into the `struct plot_output` that is its input: ends the process
 * with exit code 2 unless the file's name ends in .png, .svg or .pdf and both can be written. */
extern const struct argp plot_argp;

bool plot_wanted(const struct plot_output *output);

enum { PLOT_NAME = 56, PLOT_TABLES = 96 };

/* A picture under way: write gnuplot commands to `script`, and rows of the table begun last to
 * `data`. */
struct plot {
    FILE *script, *data;
    const struct plot_output *output;
    unsigned width, height;
    char *script_text, *data_text;
    size_t script_size, data_size;
    size_t table_count;
    struct {
        char name[PLOT_NAME];
        size_t begin; /* of its text in data_text */
    } tables[PLOT_TABLES];
};

/* Begins a picture of so many pixels, to be ended. Exit code; complains. */
int plot_begin(struct plot *plot, const struct plot_output *output, unsigned width,
               unsigned height);

/* Begins a table of comma-separated values with these columns, which the script calls @NAME. A
 * picture has at most PLOT_TABLES. */
void plot_table(struct plot *plot, const char *name, const char *columns);

/* Writes a text as a gnuplot string; it may have several lines. */
void plot_text(const struct plot *plot, const char *text);

/* The name of a file without its folder. */
const char *plot_file_name(const char *path);

/* Lets gnuplot draw the wanted picture, and writes the files. Exit code; complains if there is no
 * gnuplot or something fails. */
int plot_end(struct plot *plot);

/* The numbers that an axis must hold. */
struct plot_range {
    double low, high;
};
static const struct plot_range PLOT_NOTHING = {1.0, -1.0};

/* Undefined numbers need no place. */
void plot_range_take(struct plot_range *range, double value);
void plot_range_take_all(struct plot_range *range, const double *values, size_t count);

/* Sets "xrange" or "yrange" to hold it, and that part of its width beyond either end. */
void plot_range_set(const struct plot *plot, const char *axis, const struct plot_range *range,
                    double margin);

/* The same of numbers > 0 on a logarithmic axis. */
void plot_range_set_log(const struct plot *plot, const char *axis, const struct plot_range *range,
                        double margin);

#endif
