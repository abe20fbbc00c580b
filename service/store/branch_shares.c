/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/branch_shares.h"

#include <math.h>

#include "numeric/spline.h"

bool branch_shares_possible(const double *recovery)
{
    for (size_t j = 1; j < INDENTATION_SAMPLES; j++)
        if (!(recovery[j] > recovery[j - 1]))
            return false;
    return recovery[0] == 0.0 && recovery[INDENTATION_SAMPLES - 1] == 1.0;
}

void branch_shares_fill(const double *recovery, double part, size_t count, double *share,
                        double scratch[BRANCH_SHARES_SCRATCH])
{
    struct spline spline = {INDENTATION_SAMPLES, scratch, scratch + INDENTATION_SAMPLES,
                            scratch + 2 * INDENTATION_SAMPLES};
    for (size_t j = 0; j < INDENTATION_SAMPLES; j++) {
        double root = cbrt(indentation_fraction(j));
        spline.value[j] = root * root;
        spline.place[j] = spline.value[j] + part * (recovery[j] - spline.value[j]);
    }
    spline_set_slopes(&spline, scratch + 3 * INDENTATION_SAMPLES);
    for (size_t i = 1; i + 1 < count; i++) {
        double slope;
        double value = spline_at(&spline, (double)i / (double)(count - 1), &slope);
        share[i] = value * sqrt(value);
    }
    share[0] = 0.0;
    share[count - 1] = 1.0;
}
