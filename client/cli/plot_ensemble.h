/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble as a picture: the histogram and the distribution of the restitution, the restitution
 * against the speed with its intervals, and what the spread comes from. */
#ifndef PERCUSS_CLI_PLOT_ENSEMBLE_H
#define PERCUSS_CLI_PLOT_ENSEMBLE_H

#include <stddef.h>
#include <stdint.h>

/* Arrays are borrowed; a count of 0 leaves its panel out. */
struct ensemble_picture {
    const char *title;
    double mean, deviation; /* of the restitution */
    size_t bins;
    const double *edges; /* [bins + 1] */
    const uint64_t *counts;
    size_t quantile_count;
    const double *probabilities, *quantiles, *quantiles_low, *quantiles_high;
    size_t sample_count; /* a thousand or two suffice */
    const double *speeds, *restitutions;
    size_t input_count;
    const char *const *inputs;
    const double *first_order, *total; /* Sobol indices */
};

/* Exit code; complains. */
int plot_ensemble(const char *file, const struct ensemble_picture *picture);

#endif
