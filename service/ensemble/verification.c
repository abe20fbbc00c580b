/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/verification.h"

#include <math.h>
#include <stdlib.h>

/* Largest difference of the quantiles of two samples of equal size, which are sorted here. */
static double quantile_shift(const struct ensemble_spec *spec, double *a, double *b, size_t count)
{
    const double *probabilities;
    size_t quantiles;
    double worst = 0.0;
    report_probabilities(spec, &probabilities, &quantiles);
    summary_sort(a, count, a);
    summary_sort(b, count, b);
    for (size_t i = 0; i < quantiles; i++)
        worst = fmax(worst, fabs(summary_quantile(a, count, probabilities[i]) -
                                 summary_quantile(b, count, probabilities[i])));
    return worst;
}

/* Restitutions of the same samples by both ways, and their differences. */
struct comparison {
    double *fast, *searched, *difference;
};

static void compare(struct report_verification *out, const struct ensemble *ensemble,
                    const struct report_material *material, struct comparison *comparison)
{
    double tolerance = ensemble->model.tolerance;
    uint64_t count = ensemble_extras(ensemble, material->done);
    size_t within = 0;
    /* both answers of every sample that was solved again */
    for (uint64_t k = 0; k < count; k++) {
        struct ensemble_extra_place place = ensemble_extra_place(ensemble, material->done, k);
        double fast = material->samples[place.sample].restitution;
        double shift = fast - material->extras[k].restitution;
        if (place.dimension != SIZE_MAX)
            break; /* the others are not of this kind */
        if (!isfinite(shift))
            continue;
        comparison->fast[out->count] = fast;
        comparison->searched[out->count] = material->extras[k].restitution;
        comparison->difference[out->count++] = shift;
        within += fabs(shift) <= tolerance;
        out->unmet += !(material->extras[k].error <= tolerance);
        out->largest = fmax(out->largest, fabs(shift));
    }
    /* the share that agrees */
    out->within = (double)within / (double)out->count;
    out->within_bounds = interval_share(within, out->count, REPORT_LEVEL);
}

bool verification_fill(struct ensemble_report *report, const struct ensemble *ensemble,
                       const struct report_material *material)
{
    /* both answers side by side */
    struct report_verification *out = &report->verification;
    uint64_t count = ensemble_extras(ensemble, report->done);
    double *memory = calloc(3 * count + 1, sizeof *memory);
    if (!memory)
        return false;
    struct comparison comparison = {memory, memory + count, memory + 2 * count};
    compare(out, ensemble, material, &comparison);
    /* what the fast one does to the mean and the deviation */
    struct moments moments = summary_moments(comparison.difference, out->count);
    struct interval_sample sample = {comparison.difference, out->count, 1, NULL, out->count,
                                     REPORT_LEVEL};
    out->mean_shift = moments.mean;
    out->mean_shift_half_width = interval_mean(&sample, &moments).high - moments.mean;
    out->deviation_shift = summary_moments(comparison.fast, out->count).deviation -
                           summary_moments(comparison.searched, out->count).deviation;
    /* and to the quantiles, last as these sort the values */
    out->quantile_shift =
        quantile_shift(&ensemble->spec, comparison.fast, comparison.searched, out->count);
    free(memory);
    return true;
}
