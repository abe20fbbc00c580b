/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "differences.h"

#include <math.h>
#include <stdlib.h>

bool differences_find(const struct measured_set *set, const struct twin *list,
                      unsigned permutations, uint64_t seed, struct differences *differences)
{
    *differences = (struct differences){0};
    size_t n = set->count;
    double *measured = calloc(3 * n, sizeof *measured), *simulated, *residuals;
    if (!measured)
        return false;
    simulated = measured + n;
    residuals = measured + 2 * n;
    double squares = 0.0;
    /* impact by impact */
    for (size_t i = 0; i < n; i++) {
        const struct measured_impact *impact = &set->impacts[i];
        const struct measured_impact *twin = &list[i].impact;
        measured[i] = impact->restitution;
        simulated[i] = twin->restitution;
        residuals[i] = simulated[i] - measured[i];
        squares += residuals[i] * residuals[i];
        differences->counted += !isnan(impact->sub_impacts);
        differences->counts_equal += impact->sub_impacts == twin->sub_impacts;
    }
    /* moments; the interval of the residual's mean by Student's t */
    differences->measured_mean = sample_mean(measured, n);
    differences->measured_deviation = sample_deviation(measured, n);
    differences->simulated_mean = sample_mean(simulated, n);
    differences->simulated_deviation = sample_deviation(simulated, n);
    differences->residual_mean = sample_mean(residuals, n);
    differences->residual_half_width = n > 1 ? student_quantile(0.975, (double)(n - 1)) *
                                                   sample_deviation(residuals, n) / sqrt((double)n)
                                             : NAN;
    differences->residual_rms = sqrt(squares / (double)n);
    /* whether both may be samples of one distribution */
    bool good =
        distance_kolmogorov(measured, n, simulated, n, &differences->kolmogorov) &&
        distance_energy(measured, n, simulated, n, permutations, seed, &differences->energy);
    free(measured);
    return good;
}
