/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/mesh/element.c. */
#include <string.h>

#include "check.h"
#include "mesh/element.h"

static const enum element_type TYPES[] = {ELEMENT_TET10, ELEMENT_WEDGE15, ELEMENT_HEX20,
                                          ELEMENT_HEX27};

/* A shape function is one at its node and zero at the others. */
static void test_shapes_at_nodes(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNT(TYPES); t++)
        for (size_t n = 0; n < element_node_count(TYPES[t]); n++) {
            double at[3], shape[ELEMENT_MOST_NODES], gradient[ELEMENT_MOST_NODES][3];
            element_node(TYPES[t], n, at);
            element_shapes(TYPES[t], at, shape, gradient);
            for (size_t m = 0; m < element_node_count(TYPES[t]); m++)
                near(shape[m], m == n ? 1.0 : 0.0, 1e-15);
        }
}

/* 1, x, y, z, x^2, ... yz: every element of second order has them all. */
static void quadratics(const double x[3], double value[10], double gradient[10][3])
{
    value[0] = 1.0;
    memset(gradient, 0, 10 * sizeof *gradient);
    for (int i = 0, at = 4; i < 3; i++) {
        value[1 + i] = x[i];
        gradient[1 + i][i] = 1.0;
        for (int j = i; j < 3; j++, at++) {
            value[at] = x[i] * x[j];
            gradient[at][i] += x[j];
            gradient[at][j] += x[i];
        }
    }
}

/* Interpolated and differentiated exactly; rounding of some ten terms. */
static void test_quadratics_are_exact(void **state)
{
    (void)state;
    static const double at[3] = {0.21, 0.33, 0.17};
    for (size_t t = 0; t < COUNT(TYPES); t++) {
        double shape[ELEMENT_MOST_NODES], gradient[ELEMENT_MOST_NODES][3];
        double expected[10], slope[10][3];
        element_shapes(TYPES[t], at, shape, gradient);
        quadratics(at, expected, slope);
        for (int f = 0; f < 10; f++) {
            double value = 0.0, derivative[3] = {0.0};
            for (size_t n = 0; n < element_node_count(TYPES[t]); n++) {
                double node[3], there[10], unused[10][3];
                element_node(TYPES[t], n, node);
                quadratics(node, there, unused);
                value += shape[n] * there[f];
                for (int k = 0; k < 3; k++)
                    derivative[k] += gradient[n][k] * there[f];
            }
            near(value, expected[f], 1e-14);
            for (int k = 0; k < 3; k++)
                near(derivative[k], slope[f][k], 1e-14);
        }
    }
}

/* a! b! c!/(a + b + c + 3)! over the tetrahedron. */
static double tet_integral(int a, int b, int c)
{
    return tgamma(a + 1.0) * tgamma(b + 1.0) * tgamma(c + 1.0) / tgamma(a + b + c + 4.0);
}

static double hex_integral(int a, int b, int c)
{
    return a % 2 || b % 2 || c % 2 ? 0.0 : 8.0 / ((a + 1.0) * (b + 1.0) * (c + 1.0));
}

/* a! b!/(a + b + 2)! over the triangle, times the line. */
static double wedge_integral(int a, int b, int c)
{
    return tgamma(a + 1.0) * tgamma(b + 1.0) / tgamma(a + b + 3.0) *
           (c % 2 ? 0.0 : 2.0 / (c + 1.0));
}

/* Every monomial up to degree 5 to rounding; positive weights. */
static void test_quadrature_is_of_degree_five(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNT(TYPES); t++) {
        struct element_rule rule;
        element_rule_make(TYPES[t], &rule);
        for (int a = 0; a <= 5; a++)
            for (int b = 0; a + b <= 5; b++)
                for (int c = 0; a + b + c <= 5; c++) {
                    double sum = 0.0;
                    for (size_t p = 0; p < rule.point_count; p++) {
                        assert_true(rule.weight[p] > 0.0);
                        sum += rule.weight[p] * pow(rule.at[p][0], a) * pow(rule.at[p][1], b) *
                               pow(rule.at[p][2], c);
                    }
                    near(sum,
                         TYPES[t] == ELEMENT_TET10     ? tet_integral(a, b, c)
                         : TYPES[t] == ELEMENT_WEDGE15 ? wedge_integral(a, b, c)
                                                       : hex_integral(a, b, c),
                         2e-15);
                }
    }
}

/* An affine image: volume and gradients are the matrix's own. */
static void test_map_to_space(void **state)
{
    (void)state;
    static const double matrix[3][3] = {{2.0, 0.3, 0.0}, {0.0, 1.5, -0.2}, {0.1, 0.0, 0.7}};
    double det = 2.0 * 1.5 * 0.7 + 0.3 * -0.2 * 0.1;
    double points[10][3];
    for (size_t n = 0; n < 10; n++) {
        double at[3];
        element_node(ELEMENT_TET10, n, at);
        for (int i = 0; i < 3; i++)
            points[n][i] = 5.0 + matrix[i][0] * at[0] + matrix[i][1] * at[1] + matrix[i][2] * at[2];
    }
    struct element_rule rule;
    struct element_point here;
    double volume = 0.0;
    element_rule_make(ELEMENT_TET10, &rule);
    for (size_t p = 0; p < rule.point_count; p++) {
        element_at(&rule, p, points, &here);
        volume += here.volume;
        /* the gradient of x_i is the i-th axis */
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) {
                double slope = 0.0;
                for (size_t n = 0; n < 10; n++)
                    slope += here.gradient[n][k] * points[n][i];
                near(slope, i == k ? 1.0 : 0.0, 1e-13);
            }
    }
    near_relative(volume, det / 6.0, 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shapes_at_nodes),
        cmocka_unit_test(test_quadratics_are_exact),
        cmocka_unit_test(test_quadrature_is_of_degree_five),
        cmocka_unit_test(test_map_to_space),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
