/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Measured impacts beside their simulated twins. */
#ifndef PERCUSS_CLI_COMPARE_H
#define PERCUSS_CLI_COMPARE_H

#include "differences.h"
#include "plot.h"
#include "twins.h"

struct comparison {
    const struct scene *scene;
    const char *title; /* the scene in words */
    const struct measured_set *set;
    const struct twin *twins;
    struct differences differences;
    const struct tally *warnings; /* of the twins */
};

void compare_print_table(const struct comparison *comparison);
void compare_print_csv(const struct comparison *comparison, bool units);
void compare_print_json(const struct comparison *comparison);

/* The restitution and the number of sub-impacts against the speed, and both empirical
 * distributions. Exit code; complains. */
int compare_plot(const struct plot_output *output, const struct comparison *comparison);

#endif
