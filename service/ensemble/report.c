/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/report.h"

#include <math.h>
#include <stdlib.h>

static const double default_quantiles[] = {0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975};

void report_probabilities(const struct ensemble_spec *spec, const double **probabilities,
                          size_t *count)
{
    bool given = spec->quantile_count > 0;
    *probabilities = given ? spec->quantiles : default_quantiles;
    *count = given ? spec->quantile_count : sizeof default_quantiles / sizeof *default_quantiles;
}

void report_release(struct ensemble_report *report)
{
    arena_release(&report->memory);
}

/* Largest half-width of the quantiles' intervals; infinite where one is not known. */
static double widest_quantile(const struct ensemble *ensemble, const struct interval_sample *sample)
{
    const double *probabilities;
    size_t count;
    double widest = 0.0;
    report_probabilities(&ensemble->spec, &probabilities, &count);
    for (size_t i = 0; i < count; i++) {
        struct interval interval = interval_quantile(sample, probabilities[i]);
        double half = 0.5 * (interval.high - interval.low);
        widest = fmax(widest, isnan(half) ? INFINITY : half);
    }
    return widest;
}

struct report_progress report_progress(const struct ensemble *ensemble,
                                       const struct ensemble_sample *samples, uint64_t done,
                                       bool quantiles)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    struct report_progress progress = {NAN, NAN, NAN, NAN, false};
    double *values = malloc(2 * (done + 1) * sizeof *values);
    if (!values)
        return progress;
    /* the mean so far */
    for (uint64_t i = 0; i < done; i++)
        values[i] = samples[i].restitution;
    double *sorted = values + done;
    struct interval_sample sample = {values, done, ensemble->sampling.replicates,
                                     sorted, 0,    REPORT_LEVEL};
    struct moments moments = summary_moments(values, done);
    progress.mean = moments.mean;
    progress.deviation = moments.deviation;
    progress.half_width = interval_mean(&sample, &moments).high - moments.mean;
    /* and whether the bounds asked for are met */
    bool mean_enough = spec->half_width == 0.0 || progress.half_width <= spec->half_width;
    if (quantiles && mean_enough && spec->quantile_half_width > 0.0) {
        sample.kept = summary_sort(values, done, sorted);
        progress.quantile_half_width = widest_quantile(ensemble, &sample);
    }
    progress.enough = mean_enough && (spec->quantile_half_width == 0.0 ||
                                      progress.quantile_half_width <= spec->quantile_half_width);
    free(values);
    return progress;
}
