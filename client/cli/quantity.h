/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Numbers with units on the command line: "300mm/s", "70 GPa", read as in a catalogue. One without
 * a unit is in SI units. */
#ifndef PERCUSS_CLI_QUANTITY_H
#define PERCUSS_CLI_QUANTITY_H

#include <argp.h>
#include <stdbool.h>

#include "base/units.h"

/* The allowed range, and the fault. */
struct quantity_fault {
    char text[200];
};

/* The first `length` characters, blanks at both ends left out, as a finite number. False with the
 * reason: "a speed is needed, in m/s or with a unit, such as 300 mm/s; kg is no speed". */
bool quantity_read(const char *text, size_t length, enum quantity quantity, double *number,
                   struct quantity_fault *fault);

/* Numbers of one quantity between colons. How many, -1 with the reason: `most` were read and there
 * are more, or one of them is wrong. */
int quantity_read_list(const char *text, enum quantity quantity, double *numbers, int most,
                       struct quantity_fault *fault);

/* The value of an option, >= 0 or > 0. On failure they end the process through argp_error. */
double parse_quantity(const char *option, const char *text, enum quantity quantity,
                      struct argp_state *state);
double parse_positive_quantity(const char *option, const char *text, enum quantity quantity,
                               struct argp_state *state);

/* The quantity of a name: of an uncertain input, or of a parameter of a body. */
enum quantity quantity_of(const char *name);

#endif
