/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/summary.c: intervals by hand, Beta fits of Beta and of other samples. */
#include <string.h>

#include "check.h"
#include "ensemble/summary.h"
#include "numeric/special.h"

static const struct shape_range unit = {0.0, 1.0};

/* Half at 0.1 and half at 0.7: mean 0.4, deviation just above 0.3. */
static void sigma_intervals(void **state)
{
    (void)state;
    double values[1000];
    for (int i = 0; i < 1000; i++)
        values[i] = i < 500 ? 0.1 : 0.7;
    struct moments moments = summary_moments(values, 1000);
    struct sigma_interval half = shape_sigma_interval(values, &moments, 0.5, &unit);
    near(half.covered, 0.0, 0.0);
    near(half.unphysical, 0.0, 0.0);
    struct sigma_interval two = shape_sigma_interval(values, &moments, 2.0, &unit);
    near(two.low, -0.2, 1e-3);
    near(two.high, 1.0, 1e-3);
    near(two.covered, 1.0, 0.0);
    near(two.unphysical, 0.2 / 1.2, 1e-3);
    near(two.quantile_low, 0.1, 0.0);
    near(two.quantile_high, 0.7, 0.0);
    static const struct shape_range open = {-1.0, INFINITY};
    near(shape_sigma_interval(values, &moments, 2.0, &open).unphysical, 0.0, 0.0);
}

/* Quantiles of Beta(2, 3) by bisection. */
static double beta_quantile(double p)
{
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; i++) {
        double x = 0.5 * (low + high);
        *(special_beta_cdf(2.0, 3.0, x) < p ? &low : &high) = x;
    }
    return low;
}

/* The distance from the fit, of all values one by one. */
static double distance_by_all(const double *values, size_t n, const struct beta_fit *fit)
{
    double worst = 0.0;
    for (size_t i = 0; i < n; i++) {
        double f = special_beta_cdf(fit->alpha, fit->beta, values[i]);
        worst = fmax(worst, fmax(f - (double)i / (double)n, (double)(i + 1) / (double)n - f));
    }
    return worst;
}

static void fits_a_beta(void **state)
{
    (void)state;
    enum { N = 2000 };
    double values[N];
    for (int i = 0; i < N; i++)
        values[i] = beta_quantile((i + 0.5) / N);
    struct moments moments = summary_moments(values, N);
    struct beta_fit fit = shape_fit_beta(values, &moments, &unit);
    near(fit.alpha, 2.0, 0.01);
    near(fit.beta, 3.0, 0.01);
    near(fit.distance, 0.5 / N, 1e-3);
    near(fit.distance, distance_by_all(values, N, &fit), 0.0);
    assert_true(fit.p_value > 0.99);
}

static void refuses_two_peaks(void **state)
{
    (void)state;
    double values[400];
    for (int i = 0; i < 400; i++)
        values[i] = (i < 200 ? 0.3 : 0.6) + 1e-4 * (i % 200);
    struct moments moments = summary_moments(values, 400);
    struct beta_fit fit = shape_fit_beta(values, &moments, &unit);
    assert_true(fit.alpha > 0.0 && fit.distance > 0.1 && fit.p_value < 1e-4);
    near(fit.distance, distance_by_all(values, 400, &fit), 0.0);
    /* few values */
    for (size_t n = 2; n < 8; n++) {
        for (size_t i = 0; i < n; i++)
            values[i] = 0.1 * (double)((i + 1) * (i + n) % 11);
        assert_true(summary_sort(values, n, values, &(size_t){0}));
        moments = summary_moments(values, n);
        fit = shape_fit_beta(values, &moments, &unit);
        near(fit.distance, distance_by_all(values, n, &fit), 0.0);
    }
}

static void has_none_without_a_range(void **state)
{
    (void)state;
    const double values[] = {0.1, 0.5, 0.9}, equal[] = {0.5, 0.5, 0.5}, out[] = {0.1, 0.5, 1.1};
    static const struct shape_range open = {-1.0, INFINITY};
    struct moments moments = summary_moments(values, 3);
    assert_true(isnan(shape_fit_beta(values, &moments, &open).alpha));
    moments = summary_moments(equal, 3);
    assert_true(isnan(shape_fit_beta(equal, &moments, &unit).alpha));
    moments = summary_moments(out, 3);
    assert_true(isnan(shape_fit_beta(out, &moments, &unit).alpha));
}

/* Critical values of the limiting distribution (Smirnov 1948): 1.3581 at 5 %, 1.6276 at 1 %. */
static void kolmogorov(void **state)
{
    (void)state;
    double root = sqrt(1e8);
    near(shape_kolmogorov_p(1.3581 / root, 1e8), 0.05, 1e-5);
    near(shape_kolmogorov_p(1.6276 / root, 1e8), 0.01, 1e-5);
    near(shape_kolmogorov_p(0.0, 100.0), 1.0, 0.0);
    near(shape_kolmogorov_p(0.9, 100.0), 0.0, 1e-30);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sigma_intervals),   cmocka_unit_test(fits_a_beta),
        cmocka_unit_test(refuses_two_peaks), cmocka_unit_test(has_none_without_a_range),
        cmocka_unit_test(kolmogorov),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
