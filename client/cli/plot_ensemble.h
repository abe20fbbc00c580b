/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble as a picture: the restitution against the speed with its intervals, its histogram and
 * distribution, and the causes of the spread. */
#ifndef PERCUSS_CLI_PLOT_ENSEMBLE_H
#define PERCUSS_CLI_PLOT_ENSEMBLE_H

#include <stddef.h>
#include <stdint.h>

#include "plot.h"

/* A Sobol index with its confidence interval. NAN: not known. */
struct index_share {
    double value, low, high;
};

/* The share of one input, by itself and with its interactions. */
struct input_share {
    const char *name;
    struct index_share first_order, total;
};

/* Arrays are borrowed; a count of 0 leaves its panel out. */
struct ensemble_picture {
    const char *title;
    double mean, deviation; /* of the restitution */
    size_t bins;
    const double *edges; /* [bins + 1] */
    const uint64_t *counts;
    size_t quantile_count;
    const double *probabilities, *quantiles, *quantiles_low, *quantiles_high; /* NAN: no bound */
    size_t curve_count; /* the distribution function, beside the quantiles */
    const double *curve_values, *curve_shares;
    size_t sample_count; /* of many only some are drawn, all count for mean and deviation */
    const double *speeds, *restitutions;
    const double *sub_impacts; /* how many; NULL: not told */
    size_t interval_count;     /* mean -+ so many deviations, behind the samples, widest last */
    const double *intervals_low, *intervals_high;
    size_t input_count;
    const struct input_share *inputs;
};

/* Exit code; complains. */
int plot_ensemble(const struct plot_output *output, const struct ensemble_picture *picture);

#endif
