/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Confidence intervals. Values are in the order of their points (NAN: missing), and value i belongs
 * to the independent replicate i mod R; R = 1 are plain random samples. Of replicates only the
 * spread between them counts, since points within one are not independent. A bound that the sample
 * cannot give is NAN. */
#ifndef PERCUSS_ENSEMBLE_INTERVAL_H
#define PERCUSS_ENSEMBLE_INTERVAL_H

#include <stddef.h>

#include "ensemble/summary.h"

struct interval {
    double low, high;
};

/* Data of an interval. */
struct interval_sample {
    const double *values; /* [count], in order */
    size_t count;
    size_t replicates;
    const double *sorted; /* [kept]: summary_sort of them */
    size_t kept;
    double level; /* of confidence, 0.95 */
};

/* Mean: Student's t with the standard error of the values, or of the replicates' means. */
struct interval interval_mean(const struct interval_sample *sample, const struct moments *moments);

/* Standard deviation: the delta method with the fourth moment, or the replicates' mean squares. */
struct interval interval_deviation(const struct interval_sample *sample,
                                   const struct moments *moments);

/* Quantile at p. Plain: between the order statistics that enclose the level by their binomial
 * probabilities, for any continuous distribution (Nyblom 1992, Stat. Prob. Lett. 14, 129:
 * interpolated). Replicates: quantiles at p -+ h, where h is the half-width for the share of values
 * below (Woodruff 1952). */
struct interval interval_quantile(const struct interval_sample *sample, double p);

/* A probability of which `hits` of `count` independent trials are known: Wilson's (1927). NAN
 * without any. */
struct interval interval_share(size_t hits, size_t count, double level);

#endif
