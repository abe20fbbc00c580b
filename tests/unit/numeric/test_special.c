/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/numeric/special.c: distribution functions against exact values. */
#include <string.h>

#include "check.h"
#include "numeric/special.h"

/* Python's statistics.NormalDist (Wichura's AS 241, 16 digits). */
static void normal_quantiles(void **state)
{
    (void)state;
    static const double rows[][2] = {
        {1e-12, -7.034483825301132},
        {1e-05, -4.2648907939228256},
        {0.02, -2.0537489106318225},
        {0.3, -0.5244005127080407},
        {0.5, 0.0},
        {0.9, 1.2815515655446008},
        {0.975, 1.9599639845400536},
        {0.999999, 4.753424308817089},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i][1] != 0.0)
            near_relative(special_normal_quantile(rows[i][0]), rows[i][1], 1e-13);
    assert_true(fabs(special_normal_quantile(0.5)) < 1e-15);
}

static void normal_inverts(void **state)
{
    (void)state;
    for (double z = -8.0; z < 5.0; z += 0.37)
        near_relative(special_normal_cdf(special_normal_quantile(special_normal_cdf(z))),
                      special_normal_cdf(z), 1e-13);
}

/* Whole a, b: a sum of binomial terms, by exact fractions. */
static void beta_of_whole_numbers(void **state)
{
    (void)state;
    static const double rows[][4] = {
        {1, 1, 0.25, 0.25},
        {2, 5, 0.125, 0.16652297973632812},
        {30, 70, 0.3125, 0.6175668385196693},
        {3, 2, 0.9375, 0.9784698486328125},
        {500, 600, 0.4375, 0.12798168252969838},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        near_relative(special_beta_cdf(rows[i][0], rows[i][1], rows[i][2]), rows[i][3], 1e-11);
    assert_true(special_beta_cdf(2.0, 3.0, 0.0) == 0.0);
    assert_true(special_beta_cdf(2.0, 3.0, 1.0) == 1.0);
}

/* I_x(1/2, 1/2) = 2/pi asin sqrt(x), the arcsine distribution. */
static void beta_arcsine(void **state)
{
    (void)state;
    for (double x = 0.01; x < 1.0; x += 0.07)
        near_relative(special_beta_cdf(0.5, 0.5, x), M_2_PI * asin(sqrt(x)), 1e-13);
}

/* One degree of freedom: Cauchy, tan(pi (p - 1/2)); two: (2p - 1)/sqrt(2p(1-p)); many: normal. */
static void student_closed_forms(void **state)
{
    (void)state;
    for (double p = 0.03; p < 1.0; p += 0.09) {
        near_relative(special_student_quantile(1.0, p), tan(M_PI * (p - 0.5)), 1e-11);
        near_relative(special_student_quantile(2.0, p), (2.0 * p - 1.0) / sqrt(2.0 * p * (1.0 - p)),
                      1e-11);
        near_relative(special_student_quantile(1e8, p), special_normal_quantile(p), 1e-7);
    }
    near_relative(special_student_quantile(15.0, 0.975), 2.1314495455597742, 1e-12);
}

static void binomial_sums(void **state)
{
    (void)state;
    /* 10 throws of a coin: 1, 11, 56, ... of 1024 */
    near_relative(special_binomial_cdf(0.0, 10.0, 0.5), 1.0 / 1024.0, 1e-13);
    near_relative(special_binomial_cdf(1.0, 10.0, 0.5), 11.0 / 1024.0, 1e-13);
    near_relative(special_binomial_cdf(2.0, 10.0, 0.5), 56.0 / 1024.0, 1e-13);
    assert_true(special_binomial_cdf(-1.0, 10.0, 0.5) == 0.0);
    assert_true(special_binomial_cdf(10.0, 10.0, 0.5) == 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_quantiles),      cmocka_unit_test(normal_inverts),
        cmocka_unit_test(beta_of_whole_numbers), cmocka_unit_test(beta_arcsine),
        cmocka_unit_test(student_closed_forms),  cmocka_unit_test(binomial_sums),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
