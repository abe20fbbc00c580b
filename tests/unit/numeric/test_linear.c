/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/linear.c: elimination, symmetric eigenvalues, pseudo-inverse. */
#include <string.h>

#include "check.h"
#include "numeric/linear.h"

enum { N = 12 };

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

static void solves_random_systems(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (size_t n = 1; n <= N; n++) {
        double a[N * N], copy[N * N], b[N], x[N];
        for (size_t i = 0; i < n * n; i++)
            copy[i] = a[i] = uniform(&seed);
        for (size_t i = 0; i < n; i++)
            x[i] = b[i] = uniform(&seed);
        assert_true(linear_solve(n, a, x));
        for (size_t i = 0; i < n; i++) {
            double residual = -b[i];
            double size = 0.0;
            for (size_t j = 0; j < n; j++) {
                residual += copy[i * n + j] * x[j];
                size += fabs(copy[i * n + j] * x[j]);
            }
            /* backward stable: the residual is rounding of the terms, n of them, growth below 10 */
            near(residual, 0.0, 1e-14 * (size + 1.0));
        }
    }
}

static void needs_its_pivots(void **state)
{
    (void)state;
    double permutation[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};
    double x[3] = {1.0, 2.0, 3.0};
    assert_true(linear_solve(3, permutation, x));
    assert_true(x[0] == 3.0 && x[1] == 1.0 && x[2] == 2.0);
    double small[4] = {1e-20, 1.0, 1.0, 1.0};
    double y[2] = {1.0, 2.0};
    assert_true(linear_solve(2, small, y));
    near(y[0], 1.0, 1e-15);
    near(y[1], 1.0, 1e-15);
}

static void refuses_singular_matrices(void **state)
{
    (void)state;
    double zero[1] = {0.0};
    double nan[1] = {NAN};
    double equal[4] = {1.0, 2.0, 2.0, 4.0};
    double x[2] = {1.0, 1.0};
    assert_false(linear_solve(1, zero, x));
    assert_false(linear_solve(1, nan, x));
    assert_false(linear_solve(2, equal, x));
}

/* Second differences: eigenvalues 2 - 2 cos(k pi/(n+1)). */
static void finds_eigenvalues_and_vectors(void **state)
{
    (void)state;
    double a[N * N] = {0.0}, copy[N * N], values[N];
    for (size_t i = 0; i < N; i++) {
        a[i * N + i] = 2.0;
        if (i + 1 < N)
            a[i * N + i + 1] = a[(i + 1) * N + i] = -1.0;
    }
    memcpy(copy, a, sizeof a);
    assert_true(linear_symmetric_eigen(N, a, values));
    for (size_t k = 0; k < N; k++) {
        near(values[k], 2.0 - 2.0 * cos((double)(k + 1) * M_PI / (N + 1)), 1e-14);
        for (size_t i = 0; i < N; i++) {
            double image = 0.0;
            for (size_t j = 0; j < N; j++)
                image += copy[i * N + j] * a[k * N + j];
            near(image, values[k] * a[k * N + i], 1e-14); /* vector k in row k */
        }
        for (size_t l = 0; l <= k; l++) {
            double product = 0.0;
            for (size_t i = 0; i < N; i++)
                product += a[k * N + i] * a[l * N + i];
            near(product, k == l ? 1.0 : 0.0, 1e-14);
        }
    }
}

/* Penrose's conditions for a matrix of rank r = B B^T. */
static void pseudo_inverse_obeys_penrose(void **state)
{
    (void)state;
    enum { M = 6 };
    uint64_t seed = 7;
    for (size_t rank = 1; rank <= M; rank++) {
        double b[M * M], a[M * M] = {0.0}, p[M * M], ap[M * M] = {0.0}, scratch[M * (M + 1)];
        for (size_t i = 0; i < M * rank; i++)
            b[i] = uniform(&seed);
        for (size_t i = 0; i < M; i++)
            for (size_t j = 0; j < M; j++)
                for (size_t k = 0; k < rank; k++)
                    a[i * M + j] += b[i * rank + k] * b[j * rank + k];
        double ratio = linear_pseudo_inverse(M, a, 1e-12, p, scratch);
        assert_true(rank < M ? fabs(ratio) < 1e-14 : ratio > 1e-12);
        for (size_t i = 0; i < M; i++)
            for (size_t j = 0; j < M; j++)
                for (size_t k = 0; k < M; k++)
                    ap[i * M + j] += a[i * M + k] * p[k * M + j];
        for (size_t i = 0; i < M; i++) {
            for (size_t j = 0; j < M; j++) {
                double apa = 0.0;
                for (size_t k = 0; k < M; k++)
                    apa += ap[i * M + k] * a[k * M + j];
                /* rounding times the condition of the nonzero part, some 1e3 here */
                near(apa, a[i * M + j], 1e-12);
                near(ap[i * M + j], ap[j * M + i], 1e-11);
                near(p[i * M + j], p[j * M + i], 1e-11 * fabs(p[i * M + i]));
            }
        }
    }
    double indefinite[4] = {1.0, 2.0, 2.0, 1.0};
    double inverse[4], scratch[6];
    near(linear_pseudo_inverse(2, indefinite, 1e-12, inverse, scratch), -1.0 / 3.0, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves_random_systems),
        cmocka_unit_test(needs_its_pivots),
        cmocka_unit_test(refuses_singular_matrices),
        cmocka_unit_test(finds_eigenvalues_and_vectors),
        cmocka_unit_test(pseudo_inverse_obeys_penrose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
