/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/summary.c: statistics of samples that can be reckoned by hand. */
#include <string.h>

#include "check.h"
#include "ensemble/summary.h"

#define agrees(value, expected) near(value, expected, 1e-13 * fmax(1.0, fabs(expected)))

/* 2 4 4 4 5 5 7 9: mean 5, squares 32, cubes 42, fourth powers 356 */
static const double eight[] = {9.0, 2.0, NAN, 4.0, 5.0, 4.0, 7.0, 4.0, 5.0};

static void moments(void **state)
{
    (void)state;
    struct moments m = summary_moments(eight, 9);
    assert_int_equal(m.count, 8);
    agrees(m.mean, 5.0);
    agrees(m.deviation, sqrt(32.0 / 7.0));
    agrees(m.skewness, sqrt(56.0) / 6.0 * (42.0 / 8.0) / 8.0);
    agrees(m.fourth, 356.0 / 8.0);
    agrees(m.lowest, 2.0);
    agrees(m.highest, 9.0);
}

/* A large offset costs no digits of the deviation. */
static void moments_of_an_offset(void **state)
{
    (void)state;
    double values[] = {1e9 + 1.0, 1e9 + 2.0, 1e9 + 3.0};
    struct moments m = summary_moments(values, 3);
    agrees(m.deviation, 1.0);
    agrees(m.skewness, 0.0);
}

static void moments_of_few(void **state)
{
    (void)state;
    double one = 3.0, none = NAN;
    struct moments m = summary_moments(&one, 1);
    agrees(m.mean, 3.0);
    assert_true(isnan(m.deviation) && isnan(m.skewness));
    m = summary_moments(&none, 1);
    assert_int_equal(m.count, 0);
    assert_true(isnan(m.mean) && isnan(m.lowest));
}

/* What rounding leaves in a sum of equal values is no spread, and has no skewness; a
 * difference of a billionth is one. */
static void moments_of_equal_values(void **state)
{
    (void)state;
    double values[16];
    for (int i = 0; i < 16; i++)
        values[i] = 0.43077217;
    for (int pass = 0; pass < 2; pass++) {
        struct moments m = summary_moments(values, 16);
        assert_false(summary_varies(&m));
        assert_true(m.mean >= m.lowest && m.mean <= m.highest);
        assert_true(m.deviation == 0.0 && m.fourth == 0.0 && isnan(m.skewness));
        values[3] = nextafter(values[3], 1.0); /* equal but for rounding */
    }
    values[3] = values[0] * (1.0 + 1e-9);
    struct moments m = summary_moments(values, 16);
    assert_true(summary_varies(&m) && m.deviation > 0.0 && m.skewness > 3.0);
}

static void quantiles(void **state)
{
    (void)state;
    double sorted[9];
    size_t n;
    assert_true(summary_sort(eight, 9, sorted, &n));
    assert_int_equal(n, 8);
    agrees(summary_quantile(sorted, n, 0.5), 4.5);
    agrees(summary_quantile(sorted, n, 0.0), 2.0);
    agrees(summary_quantile(sorted, n, 1.0), 9.0);
    agrees(summary_quantile(sorted, n, 0.9), 7.0 + 0.3 * 2.0); /* place 6.3 */
    agrees(summary_share(sorted, n, 4.0), 0.5);
    agrees(summary_share(sorted, n, 3.9), 0.125);
    agrees(summary_share(sorted, n, 9.0), 1.0);
    agrees(summary_share(sorted, n, 1.0), 0.0);
    assert_true(isnan(summary_quantile(sorted, 0, 0.5)));
}

static void histogram(void **state)
{
    (void)state;
    const double sorted[] = {0.0, 0.1, 1.0, 1.5, 2.0, 4.0};
    double edges[5];
    uint64_t counts[4];
    summary_histogram(sorted, 6, 4, edges, counts);
    const uint64_t expected[] = {2, 2, 1, 1};
    assert_memory_equal(counts, expected, sizeof expected);
    agrees(edges[0], 0.0);
    agrees(edges[3], 3.0);
    agrees(edges[4], 4.0);
    assert_int_equal(summary_bins(10), 8);
    assert_int_equal(summary_bins(400), 20);
    assert_int_equal(summary_bins(1000000), 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments),        cmocka_unit_test(moments_of_an_offset),
        cmocka_unit_test(moments_of_few), cmocka_unit_test(moments_of_equal_values),
        cmocka_unit_test(quantiles),      cmocka_unit_test(histogram),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
