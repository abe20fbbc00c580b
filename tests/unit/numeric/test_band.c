/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/band.c: solutions against elimination, a factor whose leading part is
 * kept, refusals. */
#include <string.h>

#include "check.h"
#include "numeric/band.h"
#include "numeric/linear.h"

enum { N = 23, WIDTH = 4 };

/* diagonally dominant, varied */
static double entry(size_t i, size_t j, double more)
{
    return i == j ? 10.0 + (double)i + more : sin((double)(3 * i + 7 * j));
}

static void fill(struct band *band, size_t from, double more)
{
    for (size_t j = 0; j < N; j++)
        for (size_t i = j; i <= j + WIDTH && i < N; i++)
            *band_entry(band, i, j) = entry(i, j, j >= from ? more : 0.0);
}

static void expect(size_t from, double more, const double *b, double *x)
{
    double dense[N * N] = {0.0};
    for (size_t j = 0; j < N; j++)
        for (size_t i = j; i <= j + WIDTH && i < N; i++)
            dense[i * N + j] = dense[j * N + i] = entry(i, j, j >= from ? more : 0.0);
    memcpy(x, b, N * sizeof *b);
    assert_true(linear_solve(N, dense, x));
}

static void same(const double *x, const double *y)
{
    for (size_t i = 0; i < N; i++)
        near(x[i], y[i], 1e-14);
}

static void solves(void **state)
{
    (void)state;
    double values[N * (WIDTH + 1)], b[N], x[N];
    struct band band = {N, WIDTH, values};
    fill(&band, 0, 0.0);
    for (size_t i = 0; i < N; i++)
        b[i] = cos((double)i);
    expect(0, 0.0, b, x);
    assert_true(band_factor(&band));
    band_forward(&band, 0, N, b);
    band_backward(&band, 0, N, b);
    same(b, x);
}

static void keeps_the_leading_part(void **state)
{
    (void)state;
    double first_values[N * (WIDTH + 1)], values[N * (WIDTH + 1)];
    struct band leading = {N, WIDTH, first_values}, band = {N, WIDTH, values};
    fill(&leading, 0, 0.0);
    assert_true(band_factor(&leading));
    for (size_t first = 0; first < N; first += 3) {
        double b[N], x[N];
        for (size_t i = 0; i < N; i++)
            b[i] = 1.0 / (double)(i + 1);
        expect(first, 2.5, b, x);
        fill(&band, first, 2.5);
        assert_true(band_factor_trailing(&band, &leading, first));
        band_forward(&leading, 0, first, b);
        band_carry_forward(&leading, first, b, b);
        band_forward(&band, first, N, b);
        band_backward(&band, first, N, b);
        band_carry_backward(&leading, first, b, b);
        band_backward(&leading, 0, first, b);
        same(b, x);
    }
}

static void refuses_indefinite(void **state)
{
    (void)state;
    double values[N * (WIDTH + 1)];
    struct band band = {N, WIDTH, values};
    fill(&band, 0, -30.0);
    assert_false(band_factor(&band));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves),
        cmocka_unit_test(keeps_the_leading_part),
        cmocka_unit_test(refuses_indefinite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
