/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One impact on meshes that differ in the places of their nodes: its mean. */
#ifndef PERCUSS_FE_COMPLETE_MEAN_H
#define PERCUSS_FE_COMPLETE_MEAN_H

#include <stdbool.h>

#include "fe/impact_complete.h"

/* Mean of `count` results, > 0, by weights >= 0 with the sum 1. Impulses, energies, times and
 * lengths are means, so that sums and balances of each hold for it; counts are those of the result
 * of the largest weight, momentum_error the worst. False: they differ in their sub-impacts' number
 * or their ends, and have no mean. */
bool complete_mean(const struct complete_result *results, const double *weights, size_t count,
                   struct complete_result *mean);

#endif
