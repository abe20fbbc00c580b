/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/measured/distance.c against SciPy 1.17 (ks_2samp, energy_distance squared, t.ppf),
 * and that p-values are uniform when both samples come from one distribution. */
#include "check.h"
#include "distance.h"
#include "random.h"

static const double x[] = {0.1, 0.35, 0.2, 0.5, 0.9, 0.42, 0.77};
static const double y[] = {0.3, 0.6, 0.65, 0.8, 1.1, 0.95, 1.2, 0.7, 0.85};

static void agrees_with_scipy(void **state)
{
    (void)state;
    struct distance distance;
    double waves[40], others[53];
    assert_true(distance_kolmogorov(x, 7, y, 9, &distance));
    near_relative(distance.value, 0.6031746031746031, 1e-14);
    near_relative(distance.p, 0.07867132867132867, 1e-12);
    assert_true(distance_energy(x, 7, y, 9, 9, 1, &distance));
    near_relative(distance.value, 0.24448979591836736, 1e-13);
    for (int i = 0; i < 40; i++)
        waves[i] = sin((i + 1) * 1.7);
    for (int i = 0; i < 53; i++)
        others[i] = sin((i + 1) * 2.3) + 0.2;
    assert_true(distance_kolmogorov(waves, 40, others, 53, &distance));
    near_relative(distance.value, 0.225, 1e-14);
    near_relative(distance.p, 0.1614372435447382, 1e-11);
    assert_true(distance_energy(waves, 40, others, 53, 9, 1, &distance));
    near_relative(distance.value, 0.04904979606678079, 1e-12);
}

/* The same samples of a thousand values each: exact and asymptotic p-values meet. */
static void large_samples_meet_the_limit(void **state)
{
    (void)state;
    enum { N = 7000 };
    static double a[N], b[N];
    struct random random = {5};
    struct distance exact, limit;
    for (int i = 0; i < N; i++) {
        a[i] = random_normal(&random);
        b[i] = random_normal(&random) + 0.02;
    }
    assert_true(distance_kolmogorov(a, 6000, b, 6000, &exact));
    assert_true(distance_kolmogorov(a, N, b, N, &limit));
    assert_true(exact.p > 0.0 && exact.p < 1.0 && limit.p > 0.0 && limit.p < 1.0);
    assert_true(fabs(exact.value - limit.value) < 0.01);
    /* nothing alike */
    for (int i = 0; i < N; i++)
        b[i] += 3.0;
    assert_true(distance_kolmogorov(a, 200, b, 200, &exact));
    assert_true(exact.p < 1e-12);
    assert_true(distance_kolmogorov(a, 200, a, 200, &exact));
    assert_true(exact.value == 0.0 && exact.p == 1.0);
    assert_false(distance_kolmogorov(a, 0, b, 3, &exact));
    assert_false(distance_energy(a, 3, b, 0, 9, 1, &exact));
}

/* Share of p-values below 5 %, of 600 pairs of samples. */
static void small_p_values_are_rare_by_chance(void **state)
{
    (void)state;
    struct random random = {11};
    int kolmogorov = 0, energy = 0, found = 0;
    for (int trial = 0; trial < 600; trial++) {
        double a[30], b[40];
        struct distance distance;
        for (int i = 0; i < 30; i++)
            a[i] = random_normal(&random);
        for (int i = 0; i < 40; i++)
            b[i] = random_normal(&random);
        assert_true(distance_kolmogorov(a, 30, b, 40, &distance));
        kolmogorov += distance.p < 0.05;
        assert_true(distance_energy(a, 30, b, 40, 199, (uint64_t)trial, &distance));
        energy += distance.p <= 0.05;
        for (int i = 0; i < 40; i++)
            b[i] += 1.5;
        assert_true(distance_energy(a, 30, b, 40, 199, (uint64_t)trial, &distance));
        found += distance.p <= 0.05;
    }
    /* 30 expected, deviation 5.3; the first test's steps make it miss some */
    assert_in_range(kolmogorov, 8, 50);
    assert_in_range(energy, 12, 50);
    assert_true(found > 590);
}

static void quantiles_of_student(void **state)
{
    (void)state;
    near_relative(student_quantile(0.975, 1), 12.706204736174694, 1e-9);
    near_relative(student_quantile(0.975, 4), 2.7764451051977934, 1e-9);
    near_relative(student_quantile(0.95, 10), 1.8124611228116756, 1e-9);
    near_relative(student_quantile(0.995, 48), 2.6822040269502154, 1e-9);
    near_relative(student_quantile(0.975, 1000.5), 1.962337892459348, 1e-8);
    near_relative(student_quantile(0.025, 7), -2.3646242515927844, 1e-9);
}

static void moments_and_medians(void **state)
{
    (void)state;
    double values[] = {4.0, 1.0, 3.0, 2.0};
    near_relative(sample_mean(values, 4), 2.5, 1e-15);
    near_relative(sample_deviation(values, 4), 1.2909944487358056, 1e-14);
    assert_true(sample_median(values, 4) == 2.5);
    assert_true(sample_median(values, 3) == 2.0);
    assert_true(isnan(sample_median(values, 0)) && isnan(sample_mean(values, 0)));
    assert_true(isnan(sample_deviation(values, 1)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_scipy),
        cmocka_unit_test(large_samples_meet_the_limit),
        cmocka_unit_test(small_p_values_are_rare_by_chance),
        cmocka_unit_test(quantiles_of_student),
        cmocka_unit_test(moments_and_medians),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
