/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/numeric/elliptic.c: Carlson's integrals against mpmath and identities. */
#include "check.h"
#include "numeric/elliptic.h"

/* y, z, elliprf(0, y, z), elliprd(0, y, z) of mpmath 1.3 at 40 digits. */
static const double digits[][4] = {
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

static void matches_mpmath(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof digits / sizeof *digits; i++) {
        const double *row = digits[i];
        /* a few roundings in each of some ten steps */
        near_relative(elliptic_rf0(row[0], row[1]), row[2], 2e-15);
        near_relative(elliptic_rd0(row[0], row[1]), row[3], 4e-15);
    }
}

/* R_F is symmetric and homogeneous of degree -1/2, R_D homogeneous of degree -3/2, and Legendre's
 * relation couples them (DLMF 19.20.1, 19.7.1): K E' + E K' - K K' = pi/2. */
static void obeys_the_identities(void **state)
{
    (void)state;
    for (double m = 0.01; m < 1.0; m += 0.07) {
        double q = 1.0 - m;
        near_relative(elliptic_rf0(q, 1.0), elliptic_rf0(1.0, q), 1e-15);
        near_relative(elliptic_rf0(9.0 * q, 9.0), elliptic_rf0(q, 1.0) / 3.0, 2e-15);
        near_relative(elliptic_rd0(4.0 * q, 4.0), elliptic_rd0(q, 1.0) / 8.0, 4e-15);
        double k = elliptic_rf0(q, 1.0);
        double k1 = elliptic_rf0(m, 1.0);
        double e = k - m * elliptic_rd0(q, 1.0) / 3.0;
        double e1 = k1 - q * elliptic_rd0(m, 1.0) / 3.0;
        near_relative(k * e1 + e * k1 - k * k1, 0.5 * M_PI, 1e-14);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matches_mpmath),
        cmocka_unit_test(obeys_the_identities),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
