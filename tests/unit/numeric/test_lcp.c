/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/lcp.c: Lemke's method judged by the complementarity of its answers. */
#include <string.h>

#include "check.h"
#include "numeric/lcp.h"

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

/* 0 <= z, 0 <= w = m z + q, z_i w_i = 0, each to the promised 1e-8 of max |q|. */
static void judge(size_t n, const double *m, const double *q, const double *z)
{
    double scale = 0.0;
    for (size_t i = 0; i < n; i++)
        scale = fmax(scale, fabs(q[i]));
    for (size_t i = 0; i < n; i++) {
        double w = q[i];
        for (size_t j = 0; j < n; j++)
            w += m[i * n + j] * z[j];
        assert_true(z[i] >= 0.0);
        assert_true(w >= -1e-8 * scale);
        assert_true(fmin(w, m[i * n + i] * z[i]) <= 1e-8 * scale);
    }
}

/* m = B B^T with B n x rank: definite where rank >= n. */
static void gram(uint64_t *seed, size_t n, size_t rank, double *m)
{
    double *b = malloc(n * rank * sizeof *b);
    assert_non_null(b);
    for (size_t i = 0; i < n * rank; i++)
        b[i] = uniform(seed);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            m[i * n + j] = 0.0;
            for (size_t k = 0; k < rank; k++)
                m[i * n + j] += b[i * rank + k] * b[j * rank + k];
        }
    free(b);
}

static void solves_by_hand(void **state)
{
    (void)state;
    double z[2];
    const double m[4] = {2.0, 1.0, 1.0, 2.0};
    assert_int_equal(lcp_solve(2, m, (double[]){1.0, 2.0}, z), LCP_SOLVED);
    assert_true(z[0] == 0.0 && z[1] == 0.0);
    assert_int_equal(lcp_solve(2, m, (double[]){-1.0, 2.0}, z), LCP_SOLVED);
    assert_true(fabs(z[0] - 0.5) < 1e-9 && z[1] == 0.0); /* the diagonal is raised by 1e-10 */
    assert_int_equal(lcp_solve(2, m, (double[]){-3.0, -3.0}, z), LCP_SOLVED);
    assert_true(fabs(z[0] - 1.0) < 1e-9 && fabs(z[1] - 1.0) < 1e-9);
    assert_int_equal(lcp_solve(1, m, (double[]){-3.0}, z), LCP_SOLVED);
    assert_true(fabs(z[0] - 1.5) < 1e-9);
}

static void solves_random_definite_problems(void **state)
{
    (void)state;
    static double m[64 * 64], q[64], z[64];
    uint64_t seed = 2;
    for (int trial = 0; trial < 300; trial++) {
        size_t n = 1 + (size_t)trial % 64;
        gram(&seed, n, n + 4, m);
        for (size_t i = 0; i < n; i++)
            q[i] = uniform(&seed);
        assert_int_equal(lcp_solve(n, m, q, z), LCP_SOLVED);
        judge(n, m, q, z);
    }
}

/* Redundant contacts: q = w^T (velocities) lies in the range, so that a solution exists. */
static void solves_singular_problems_of_contacts(void **state)
{
    (void)state;
    static double m[32 * 32], q[32], z[32], w[32 * 6];
    uint64_t seed = 3;
    for (int trial = 0; trial < 300; trial++) {
        size_t n = 7 + (size_t)trial % 26;
        for (size_t i = 0; i < 6 * n; i++)
            w[i] = uniform(&seed);
        /* a contact stated twice */
        memcpy(w + 6, w, 6 * sizeof *w);
        for (size_t i = 0; i < n; i++) {
            for (size_t j = 0; j < n; j++) {
                m[i * n + j] = 0.0;
                for (size_t k = 0; k < 6; k++)
                    m[i * n + j] += w[6 * i + k] * w[6 * j + k];
            }
        }
        double velocity[6];
        for (size_t k = 0; k < 6; k++)
            velocity[k] = uniform(&seed);
        for (size_t i = 0; i < n; i++) {
            q[i] = 0.0;
            for (size_t k = 0; k < 6; k++)
                q[i] += w[6 * i + k] * velocity[k];
        }
        assert_int_equal(lcp_solve(n, m, q, z), LCP_SOLVED);
        judge(n, m, q, z);
    }
}

/* Murty's matrix (lower triangular of ones, twos below) makes complementary pivoting walk through
 * exponentially many bases in some rules; made symmetric positive definite as m m^T. */
static void solves_murty_s_problems(void **state)
{
    (void)state;
    for (size_t n = 2; n <= 14; n++) {
        double lower[14 * 14] = {0.0}, m[14 * 14] = {0.0}, q[14], z[14];
        for (size_t i = 0; i < n; i++) {
            q[i] = -1.0;
            for (size_t j = 0; j <= i; j++)
                lower[i * n + j] = i == j ? 1.0 : 2.0;
        }
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                for (size_t k = 0; k < n; k++)
                    m[i * n + j] += lower[i * n + k] * lower[j * n + k];
        assert_int_equal(lcp_solve(n, m, q, z), LCP_SOLVED);
        judge(n, m, q, z);
    }
}

/* Units must not matter: W of a nut and of a ship's hull. */
static void solves_at_any_scale(void **state)
{
    (void)state;
    static double m[100], q[10], z[10], scaled[100], small[10], again[10];
    uint64_t seed = 5;
    gram(&seed, 10, 10, m);
    for (size_t i = 0; i < 10; i++)
        q[i] = uniform(&seed) - 0.3;
    assert_int_equal(lcp_solve(10, m, q, z), LCP_SOLVED);
    for (double scale = 1e-12; scale < 1e13; scale *= 1e4) {
        for (size_t i = 0; i < 100; i++)
            scaled[i] = scale * m[i];
        for (size_t i = 0; i < 10; i++)
            small[i] = 1e-6 * q[i];
        assert_int_equal(lcp_solve(10, scaled, small, again), LCP_SOLVED);
        judge(10, scaled, small, again);
        for (size_t i = 0; i < 10; i++)
            assert_true(fabs(again[i] - 1e-6 / scale * z[i]) <= 1e-12 / scale);
    }
}

/* Diagonals that differ by many orders: a light and a heavy body. */
static void solves_badly_scaled_problems(void **state)
{
    (void)state;
    double m[16], z[4];
    const double base[16] = {4, 1, 0.5, 1, 1, 3, 1, 0, 0.5, 1, 5, 2, 1, 0, 2, 6};
    const double size[4] = {1.0, 1e-3, 1e3, 1e-1};
    const double q[4] = {-1.0, -2.0, 0.5, -0.1};
    for (size_t i = 0; i < 4; i++)
        for (size_t j = 0; j < 4; j++)
            m[4 * i + j] = base[4 * i + j] * size[i] * size[j];
    assert_int_equal(lcp_solve(4, m, q, z), LCP_SOLVED);
    judge(4, m, q, z);
}

/* Nothing can push this apart: 0 z - 1 >= 0 has no solution. */
static void admits_defeat(void **state)
{
    (void)state;
    double z[2];
    const double zero[1] = {0.0};
    const double line[4] = {1.0, -1.0, -1.0, 1.0};
    assert_int_equal(lcp_solve(1, zero, (double[]){-1.0}, z), LCP_UNSOLVED);
    /* z0 - z1 >= 1 and z1 - z0 >= 1 */
    assert_int_equal(lcp_solve(2, line, (double[]){-1.0, -1.0}, z), LCP_UNSOLVED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves_by_hand),
        cmocka_unit_test(solves_random_definite_problems),
        cmocka_unit_test(solves_singular_problems_of_contacts),
        cmocka_unit_test(solves_murty_s_problems),
        cmocka_unit_test(solves_at_any_scale),
        cmocka_unit_test(solves_badly_scaled_problems),
        cmocka_unit_test(admits_defeat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
