/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/collocation.c: every number of the table from its definition. */
#include "check.h"
#include "impact/collocation.h"

/* Lagrange's polynomial j at s, by its product. */
static double lagrange(int j, double s)
{
    double product = 1.0;
    for (int i = 0; i < NODES; i++)
        if (i != j)
            product *= (s - collocation.node[i]) / (collocation.node[j] - collocation.node[i]);
    return product;
}

/* Gauss-Legendre: roots of P_4 on 0..1, exact for degree 7. */
static void nodes_and_weights_are_gauss_s(void **state)
{
    (void)state;
    for (int i = 0; i < NODES; i++) {
        double x = 2.0 * collocation.node[i] - 1.0;
        near((35.0 * x * x * x * x - 30.0 * x * x + 3.0) / 8.0, 0.0, 4e-15);
    }
    for (int degree = 0; degree <= 7; degree++) {
        double sum = 0.0;
        for (int i = 0; i < NODES; i++)
            sum += collocation.weight[i] * pow(collocation.node[i], degree);
        near(sum, 1.0 / (degree + 1), 2e-16);
    }
}

static void values_and_integrals_of_polynomials(void **state)
{
    (void)state;
    for (double s = 0.0; s <= 1.0; s += 0.0625) {
        for (int j = 0; j < NODES; j++) {
            double unit[NODES] = {0.0};
            unit[j] = 1.0;
            /* monomials of up to 31 cancel: 31 roundings */
            near(collocation_value(unit, s), lagrange(j, s), 1e-14);
        }
        for (int degree = 0; degree < NODES; degree++) {
            double values[NODES];
            for (int i = 0; i < NODES; i++)
                values[i] = pow(collocation.node[i], degree);
            near(collocation_value(values, s), pow(s, degree), 1e-14);
            near(collocation_integral(values, s), pow(s, degree + 1) / (degree + 1), 1e-14);
        }
    }
}

/* The Taylor series from the end is the polynomial. */
static void series_at_the_end(void **state)
{
    (void)state;
    for (double s = 0.0; s <= 2.0; s += 0.125)
        for (int j = 0; j < NODES; j++) {
            double x = s - 1.0;
            double series = collocation.end[0][j] +
                            x * (collocation.end[1][j] +
                                 x * (collocation.end[2][j] + x * collocation.end[3][j]));
            near(series, lagrange(j, s), 1e-13); /* terms of up to 31 cancel */
        }
}

/* Integral and double integral of each polynomial to each node: exact on monomials, the double one
 * is int (c - s) f ds. */
static void matrices_integrate(void **state)
{
    (void)state;
    for (int degree = 0; degree < NODES; degree++) {
        double end = 0.0;
        for (int i = 0; i < NODES; i++) {
            double c = collocation.node[i];
            double once = 0.0;
            double twice = 0.0;
            for (int j = 0; j < NODES; j++) {
                double value = pow(collocation.node[j], degree);
                once += collocation.velocity[i][j] * value;
                twice += collocation.position[i][j] * value;
            }
            near(once, pow(c, degree + 1) / (degree + 1), 2e-16);
            near(twice, pow(c, degree + 2) / ((degree + 1) * (degree + 2)), 2e-16);
            end += collocation.position_end[i] * pow(c, degree);
        }
        near(end, 1.0 / ((degree + 1) * (degree + 2)), 2e-16);
    }
}

/* The coefficient of P_3(2s - 1) = 20 s^3 - 30 s^2 + 12 s - 1. */
static void the_highest_coefficient(void **state)
{
    (void)state;
    static const double coefficients[NODES][NODES] = {
        {1, 0, 0, 0}, {-1, 2, 0, 0}, {1, -6, 6, 0}, {-1, 12, -30, 20}};
    for (int degree = 0; degree < NODES; degree++) {
        double sum = 0.0;
        for (int j = 0; j < NODES; j++) {
            double value = 0.0;
            for (int m = 0; m < NODES; m++)
                value += coefficients[degree][m] * pow(collocation.node[j], m);
            sum += collocation.highest[j] * value;
        }
        near(sum, degree == 3 ? 1.0 : 0.0, 1e-14); /* coefficients of up to 30 cancel here */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_and_weights_are_gauss_s),
        cmocka_unit_test(values_and_integrals_of_polynomials),
        cmocka_unit_test(series_at_the_end),
        cmocka_unit_test(matrices_integrate),
        cmocka_unit_test(the_highest_coefficient),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
