/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/ritz_basis.c, polynomials: orthonormal in the mean, and derivatives by differences. */
#include "model/ritz_basis.h"

#include "check.h"

enum { ORDER = 9, ANGLES = 2 * ORDER + 2 };

static void a_line(void **state)
{
    (void)state;
    double x[ORDER + 1], weight[ORDER + 1], value[ORDER], sum[ORDER][ORDER] = {{0.0}};
    polynomial_gauss(ORDER + 1, x, weight);
    for (int k = 0; k < ORDER + 1; k++) {
        polynomial_legendre(ORDER, 2.0 * x[k] - 1.0, value);
        for (int i = 0; i < ORDER; i++)
            for (int j = 0; j < ORDER; j++)
                sum[i][j] += weight[k] * value[i] * value[j];
    }
    for (int i = 0; i < ORDER; i++)
        for (int j = 0; j < ORDER; j++)
            near(sum[i][j], i == j ? 1.0 : 0.0, 1e-13);
}

/* They vanish where they are held; with none held they are Legendre's. */
static void a_held_line(void **state)
{
    (void)state;
    double x[ORDER + 3], weight[ORDER + 3], value[ORDER], other[ORDER], slope[ORDER];
    polynomial_gauss(ORDER + 3, x, weight);
    for (int ends = 0; ends < 4; ends++) {
        const bool held[2] = {ends & 1, ends & 2};
        double sum[ORDER][ORDER] = {{0.0}};
        for (int k = 0; k < ORDER + 3; k++) {
            polynomial_held(ORDER, held, 2.0 * x[k] - 1.0, value, NULL);
            for (int i = 0; i < ORDER; i++)
                for (int j = 0; j < ORDER; j++)
                    sum[i][j] += weight[k] * value[i] * value[j];
        }
        for (int i = 0; i < ORDER; i++)
            for (int j = 0; j < ORDER; j++)
                near(sum[i][j], i == j ? 1.0 : 0.0, 1e-13);
        for (int end = 0; end < 2; end++) {
            polynomial_held(ORDER, held, end ? 1.0 : -1.0, value, NULL);
            for (int i = 0; i < ORDER; i++)
                assert_true((value[i] == 0.0) == held[end]);
        }
        const double at = 0.37, step = 1e-6;
        polynomial_held(ORDER, held, at - step, other, NULL);
        polynomial_held(ORDER, held, at + step, value, slope);
        for (int i = 0; i < ORDER; i++)
            near((value[i] - other[i]) / (2.0 * step), slope[i], 1e-3);
        polynomial_legendre(ORDER, at + step, other);
        for (int i = 0; ends == 0 && i < ORDER; i++)
            near(value[i], other[i], 1e-13);
    }
}

static void a_circle(void **state)
{
    (void)state;
    static double table[POLYNOMIAL_MOST * POLYNOMIAL_MOST];
    static double sum[ORDER * ORDER][ORDER * ORDER];
    double x[ORDER + 1], weight[ORDER + 1];
    polynomial_gauss(ORDER + 1, x, weight);
    for (int k = 0; k < ORDER + 1; k++)
        for (int a = 0; a < ANGLES; a++) {
            double angle = 2.0 * M_PI * a / ANGLES, share = 2.0 * x[k] * weight[k] / ANGLES;
            polynomial_zernike(ORDER, x[k] * cos(angle), x[k] * sin(angle), table, NULL, NULL);
            for (int i = 0; i < ORDER * ORDER; i++)
                for (int j = 0; j < ORDER * ORDER; j++)
                    if (i / ORDER + i % ORDER < ORDER && j / ORDER + j % ORDER < ORDER)
                        sum[i][j] += share * table[i / ORDER * POLYNOMIAL_MOST + i % ORDER] *
                                     table[j / ORDER * POLYNOMIAL_MOST + j % ORDER];
        }
    for (int i = 0; i < ORDER * ORDER; i++)
        for (int j = 0; j < ORDER * ORDER; j++)
            near(sum[i][j], i == j && i / ORDER + i % ORDER < ORDER ? 1.0 : 0.0, 1e-12);
}

/* And parities as of y^q z^r. */
static void derivatives(void **state)
{
    (void)state;
    static double at[3][POLYNOMIAL_MOST * POLYNOMIAL_MOST];
    static double beside[4][POLYNOMIAL_MOST * POLYNOMIAL_MOST];
    const double y = 0.31, z = -0.54, step = 1e-5;
    polynomial_zernike(ORDER, y, z, at[0], at[1], at[2]);
    polynomial_zernike(ORDER, y + step, z, beside[0], NULL, NULL);
    polynomial_zernike(ORDER, y - step, z, beside[1], NULL, NULL);
    polynomial_zernike(ORDER, y, z + step, beside[2], NULL, NULL);
    polynomial_zernike(ORDER, y, z - step, beside[3], NULL, NULL);
    for (size_t q = 0; q < ORDER; q++)
        for (size_t r = 0; q + r < ORDER; r++) {
            size_t i = q * POLYNOMIAL_MOST + r;
            near(at[1][i], (beside[0][i] - beside[1][i]) / (2.0 * step), 1e-6);
            near(at[2][i], (beside[2][i] - beside[3][i]) / (2.0 * step), 1e-6);
        }
    polynomial_zernike(ORDER, -y, z, beside[0], NULL, NULL);
    polynomial_zernike(ORDER, y, -z, beside[1], NULL, NULL);
    for (size_t q = 0; q < ORDER; q++)
        for (size_t r = 0; q + r < ORDER; r++) {
            size_t i = q * POLYNOMIAL_MOST + r;
            near(beside[0][i], q % 2 ? -at[0][i] : at[0][i], 1e-12);
            near(beside[1][i], r % 2 ? -at[0][i] : at[0][i], 1e-12);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line),
        cmocka_unit_test(a_held_line),
        cmocka_unit_test(a_circle),
        cmocka_unit_test(derivatives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
