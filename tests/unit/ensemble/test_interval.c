/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/interval.c: intervals by hand, and that they are honest: over many small
 * ensembles the nominal 95 % interval covers the truth as often as it says. */
#include <string.h>

#include "check.h"
#include "ensemble/interval.h"
#include "ensemble/sampling.h"
#include "ensemble/spec.h"

#define agrees(value, expected) near(value, expected, 1e-10 * fmax(1.0, fabs(expected)))

static void plain_intervals_by_hand(void **state)
{
    (void)state;
    double values[10], sorted[10];
    for (int i = 0; i < 10; i++)
        values[i] = sorted[i] = i + 1.0;
    struct interval_sample sample = {values, 10, 1, sorted, 10, 0.95};
    struct moments moments = summary_moments(values, 10);
    /* t = 2.262157 with 9 degrees; s = sqrt(110/12) */
    struct interval mean = interval_mean(&sample, &moments);
    agrees(mean.high - 5.5, 2.2621571628540993 * sqrt(110.0 / 12.0) / sqrt(10.0));
    agrees(mean.low + mean.high, 11.0);
    /* of ten, x_(2) is above the median with probability 11/1024, x_(3) with 56/1024: the bound for
     * 0.025 lies on the way, as Nyblom interpolates */
    struct interval median = interval_quantile(&sample, 0.5);
    double way = 1.0 / (1.0 + 2.0 * (56.0 / 1024.0 - 0.025) / (8.0 * (0.025 - 11.0 / 1024.0)));
    agrees(median.low, 2.0 + way);
    agrees(median.high, 9.0 - way);
    /* ten values say nothing about what lies below the 5 % quantile */
    assert_true(isnan(interval_quantile(&sample, 0.05).low));
    assert_true(isnan(interval_quantile(&sample, 0.99).high));
}

static void replicated_mean_by_hand(void **state)
{
    (void)state;
    double values[32], sorted[32];
    /* replicate r has the values r and r + 0.5: means r + 0.25 */
    for (int i = 0; i < 32; i++)
        values[i] = i % 16 + 0.5 * (i / 16);
    size_t kept;
    assert_true(summary_sort(values, 32, sorted, &kept));
    struct interval_sample sample = {values, 32, 16, sorted, kept, 0.95};
    struct moments moments = summary_moments(values, 32);
    struct interval mean = interval_mean(&sample, &moments);
    /* the means 0.25 .. 15.25 have the variance 16 * 17/12; t with 15 degrees */
    agrees(mean.high - moments.mean, 2.1314495455597742 * sqrt(16.0 * 17.0 / 12.0) / 4.0);
}

/* A rough bimodal answer to a smooth input, as the restitution is to the speed. */
static double answer(double u)
{
    return u < 0.4 ? 0.1 + 0.3 * u : 0.6 + 0.15 * sin(60.0 * u);
}

enum { TRUTH = 400000 };

struct coverage {
    unsigned mean, median, deviation;
};

/* How often the intervals of many ensembles of `count` cover the truth, which a fine midpoint rule
 * gives. */
static struct coverage cover(enum sampling_method method, uint64_t count, unsigned trials)
{
    struct coverage covered = {0, 0, 0};
    double *truth = malloc(TRUTH * sizeof *truth);
    double *values = malloc(2 * count * sizeof *values), *sorted = values + count;
    for (size_t i = 0; i < TRUTH; i++)
        truth[i] = answer((i + 0.5) / TRUTH);
    struct moments exact = summary_moments(truth, TRUTH);
    size_t kept;
    assert_true(summary_sort(truth, TRUTH, truth, &kept));
    double median = summary_quantile(truth, TRUTH, 0.5);
    for (unsigned t = 0; t < trials; t++) {
        struct sampling sampling;
        struct fault fault;
        sampling_create(&sampling, method, 1, count, 1000 + t, &fault);
        for (uint64_t i = 0; i < count; i++) {
            double u;
            sampling_point(&sampling, i, &u);
            values[i] = answer(u);
        }
        assert_true(summary_sort(values, count, sorted, &kept));
        struct interval_sample sample = {values, count, sampling.replicates, sorted, kept, 0.95};
        struct moments moments = summary_moments(values, count);
        struct interval m = interval_mean(&sample, &moments), q = interval_quantile(&sample, 0.5);
        struct interval s = interval_deviation(&sample, &moments);
        covered.mean += m.low <= exact.mean && exact.mean <= m.high;
        covered.median += q.low <= median && median <= q.high;
        covered.deviation += s.low <= exact.deviation && exact.deviation <= s.high;
    }
    free(truth);
    free(values);
    return covered;
}

/* 1000 trials: of exact 95 % intervals 930 to 970 cover with all but 0.4 % probability. Sixteen
 * replicates' means are not quite normal, and the deviation's intervals are right for large samples
 * only: some more may miss. */
static void honest(enum sampling_method method, uint64_t count)
{
    struct coverage covered = cover(method, count, 1000);
    if (getenv("PERCUSS_MEASURE"))
        print_message("    %s %u: mean %u median %u deviation %u of 1000\n", sampling_name(method),
                      (unsigned)count, covered.mean, covered.median, covered.deviation);
    assert_in_range(covered.mean, 925, 975);
    assert_in_range(covered.median, 925, 975);
    assert_in_range(covered.deviation, 910, 980);
}

static void plain_is_honest(void **state)
{
    (void)state;
    honest(SAMPLING_IS_PLAIN, 53);
    honest(SAMPLING_IS_PLAIN, 200);
}

static void latin_hypercube_is_honest(void **state)
{
    (void)state;
    honest(SAMPLING_IS_LATIN_HYPERCUBE, 320);
}

static void sobol_is_honest(void **state)
{
    (void)state;
    honest(SAMPLING_IS_SOBOL, 512);
}

/* Better points give narrower intervals, not just narrower errors. */
static void replicates_tell_of_better_points(void **state)
{
    (void)state;
    double width[SAMPLING_METHODS];
    for (unsigned method = 0; method < SAMPLING_METHODS; method++) {
        struct sampling sampling;
        struct fault fault;
        double values[4096];
        sampling_create(&sampling, method, 1, 4096, 5, &fault);
        for (uint64_t i = 0; i < 4096; i++) {
            double u;
            sampling_point(&sampling, i, &u);
            values[i] = answer(u);
        }
        struct interval_sample sample = {values, 4096, sampling.replicates, NULL, 0, 0.95};
        struct moments moments = summary_moments(values, 4096);
        struct interval mean = interval_mean(&sample, &moments);
        width[method] = mean.high - mean.low;
    }
    assert_true(width[SAMPLING_IS_LATIN_HYPERCUBE] < 0.2 * width[SAMPLING_IS_PLAIN]);
    assert_true(width[SAMPLING_IS_SOBOL] < 0.2 * width[SAMPLING_IS_PLAIN]);
}

/* Wilson's interval: 195 of 200 by hand; of none and of all of ten it is not empty. */
static void shares_by_hand(void **state)
{
    (void)state;
    struct interval interval = interval_share(195, 200, 0.95);
    /* (p + z^2/2n -+ z sqrt(p(1-p)/n + z^2/4n^2))/(1 + z^2/n), z = 1.959964, p = 0.975 */
    assert_true(fabs(interval.low - 0.942822) < 1e-6);
    assert_true(fabs(interval.high - 0.989275) < 1e-6);
    assert_true(interval_share(0, 10, 0.95).low == 0.0);
    assert_true(fabs(interval_share(0, 10, 0.95).high - 0.277533) < 1e-6);
    assert_true(fabs(interval_share(10, 10, 0.95).high - 1.0) < 1e-12);
    assert_true(isnan(interval_share(0, 0, 0.95).low));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_intervals_by_hand),
        cmocka_unit_test(replicated_mean_by_hand),
        cmocka_unit_test(shares_by_hand),
        cmocka_unit_test(plain_is_honest),
        cmocka_unit_test(latin_hypercube_is_honest),
        cmocka_unit_test(sobol_is_honest),
        cmocka_unit_test(replicates_tell_of_better_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
