/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Uncertain inputs as they are written on the command line. */
#ifndef PERCUSS_CLI_INPUT_TEXT_H
#define PERCUSS_CLI_INPUT_TEXT_H

#include <percuss/percuss.h>

struct input_fault {
    char text[512];
};

/* "V", "uniform:LO:HI", "normal:MEAN:DEVIATION[:LOWEST:HIGHEST]", "log-normal:" the same, or
 * "list:FILE[:COLUMN]", for the quantity input->name: numbers may have its units. A list's values
 * are allocated: free((void *)input->values). False with the reason. */
bool input_text_distribution(const char *text, struct percuss_input *input,
                             struct input_fault *fault);

/* "NAME[@BODY]=DISTRIBUTION", or with a colon for the @. */
bool input_text_read(const char *text, struct percuss_input *input, struct input_fault *fault);

/* The colon or @ between a number's name and the body's id, as in young:al-beam and young@al-beam,
 * where it stands before an equals sign; NULL: there is none. */
const char *input_text_owner(const char *text);

/* One column of a file of comma-separated values: by its name in the first line, by its number from
 * 1 on, or NULL for the first. Lines without anything or beginning with # are skipped, and a first
 * line that is no number. NULL with the reason; the caller frees the values. */
double *input_text_column(const char *file, const char *column, size_t *count,
                          struct input_fault *fault);

/* A speed to state the impact at: the distribution's middle. */
double input_text_middle(const struct percuss_input *input);

#endif
