/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/special.c: distribution functions against exact values, Carlson's
 * integrals against mpmath and identities. */
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

/* y, z, elliprf(0, y, z), elliprd(0, y, z) of mpmath 1.3 at 40 elliptic_digits. */
static const double elliptic_digits[][4] = {
    {1, 1, 1.57079632679489662, 2.35619449019234493},
    {0.5, 1, 1.85407467730137192, 3.0205847775221785},
    {1e-3, 1, 4.84113256055029703, 11.528413722870426},
    {1e-8, 1, 10.5966347570876603, 28.7899044077125035},
    {1e-30, 1, 35.9250707560305759, 104.775212268091728},
    {1, 1e-12, 15.2018049190877152, 2999999999979.44729},
    {0.999999999, 1, 1.5707963271875957, 2.35619449107591786},
    {1.0000001, 1, 1.57079628752499066, 2.35619440183505707},
    {2, 3, 1.00107738045610624, 0.525853445105089125},
    {1e5, 1e-5, 0.0407909146905865465, 948.683297509801327},
};

static void elliptic_matches_mpmath(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof elliptic_digits / sizeof *elliptic_digits; i++) {
        const double *row = elliptic_digits[i];
        /* a few roundings in each of some ten steps */
        near_relative(special_elliptic_rf0(row[0], row[1]), row[2], 2e-15);
        near_relative(special_elliptic_rd0(row[0], row[1]), row[3], 4e-15);
    }
}

/* R_F is symmetric and homogeneous of degree -1/2, R_D homogeneous of degree -3/2, and Legendre's
 * relation couples them (DLMF 19.20.1, 19.7.1): K E' + E K' - K K' = pi/2. */
static void elliptic_obeys_the_identities(void **state)
{
    (void)state;
    for (double m = 0.01; m < 1.0; m += 0.07) {
        double q = 1.0 - m;
        near_relative(special_elliptic_rf0(q, 1.0), special_elliptic_rf0(1.0, q), 1e-15);
        near_relative(special_elliptic_rf0(9.0 * q, 9.0), special_elliptic_rf0(q, 1.0) / 3.0,
                      2e-15);
        near_relative(special_elliptic_rd0(4.0 * q, 4.0), special_elliptic_rd0(q, 1.0) / 8.0,
                      4e-15);
        double k = special_elliptic_rf0(q, 1.0);
        double k1 = special_elliptic_rf0(m, 1.0);
        double e = k - m * special_elliptic_rd0(q, 1.0) / 3.0;
        double e1 = k1 - q * special_elliptic_rd0(m, 1.0) / 3.0;
        near_relative(k * e1 + e * k1 - k * k1, 0.5 * M_PI, 1e-14);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_quantiles),        cmocka_unit_test(normal_inverts),
        cmocka_unit_test(beta_of_whole_numbers),   cmocka_unit_test(beta_arcsine),
        cmocka_unit_test(student_closed_forms),    cmocka_unit_test(binomial_sums),
        cmocka_unit_test(elliptic_matches_mpmath), cmocka_unit_test(elliptic_obeys_the_identities),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
