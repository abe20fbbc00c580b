/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How far measured impacts and their twins are from each other. */
#ifndef PERCUSS_TWINS_DIFFERENCES_H
#define PERCUSS_TWINS_DIFFERENCES_H

#include "distance.h"
#include "twin.h"

struct differences {
    double measured_mean, measured_deviation; /* of the restitution */
    double simulated_mean, simulated_deviation;
    double residual_mean, residual_half_width, residual_rms; /* simulated less measured */
    struct distance kolmogorov, energy;
    size_t counted, counts_equal; /* impacts with a measured number of sub-impacts */
};

/* Of a set that is complete. The energy distance's p-value is of so many random permutations.
 * False: out of memory. */
bool differences_find(const struct measured_set *set, const struct twin *list,
                      unsigned permutations, uint64_t seed, struct differences *differences);

#endif
