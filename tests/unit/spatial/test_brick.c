/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors the bricks of tests/reference/spatial/system.c: uniform strain has its energy exactly,
 * rigid motion none, the mass is the volume's, mirrored bricks are the same, folded ones are
 * refused. */
#include <string.h>

#include "check.h"
#include "spatial/system.h"

static const struct material metal = {"metal", 70e9, 0.33, 2700.0, INFINITY, 0.0};

/* a parallelepiped: its map is linear, its volume a determinant */
static const double side[3][3] = {{2e-3, 1e-4, 0.0}, {3e-4, 1e-3, 2e-4}, {0.0, -1e-4, 3e-3}};

static void place_nodes(double hand, double points[ELEMENT_MOST_NODES][3])
{
    for (size_t n = 0; n < BRICK_NODES; n++) {
        double at[3];
        element_node(ELEMENT_HEX27, n, at);
        for (int x = 0; x < 3; x++)
            points[n][x] = 0.5 * (at[0] * side[0][x] + at[1] * side[1][x] + at[2] * side[2][x]);
        points[n][2] *= hand;
    }
}

static double energy(double points[ELEMENT_MOST_NODES][3], const double gradient[3][3],
                     const double spin[3], double *mass)
{
    static double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS], m[BRICK_NODES][BRICK_NODES];
    assert_true(brick_matrices(points, &metal, stiffness, m));
    double u[BRICK_FREEDOMS], sum = 0.0;
    for (size_t n = 0; n < BRICK_NODES; n++)
        for (size_t c = 0; c < 3; c++) {
            const double *p = points[n];
            u[3 * n + c] = gradient[c][0] * p[0] + gradient[c][1] * p[1] + gradient[c][2] * p[2] +
                           spin[(c + 1) % 3] * p[(c + 2) % 3] - spin[(c + 2) % 3] * p[(c + 1) % 3] +
                           1e-3;
        }
    *mass = 0.0;
    for (size_t i = 0; i < BRICK_FREEDOMS; i++)
        for (size_t j = 0; j < BRICK_FREEDOMS; j++)
            sum += 0.5 * u[i] * stiffness[i][j] * u[j];
    for (size_t i = 0; i < BRICK_NODES; i++)
        for (size_t j = 0; j < BRICK_NODES; j++)
            *mass += m[i][j];
    return sum;
}

static void has_uniform_strain(void **state)
{
    (void)state;
    /* strains: xx 1e-3, yy 2e-3, zz -5e-4, xy (engineering) 4e-4; on top a rotation */
    const double gradient[3][3] = {{1e-3, 4e-4, 0.0}, {0.0, 2e-3, 0.0}, {0.0, 0.0, -5e-4}};
    double volume = 2e-3 * (1e-3 * 3e-3 + 1e-4 * 2e-4) - 1e-4 * (3e-4 * 3e-3);
    double mu = material_shear_modulus(&metal), lambda = 2.0 * mu * 0.33 / (1.0 - 0.66);
    double trace = 1e-3 + 2e-3 - 5e-4;
    double squares = 1e-6 + 4e-6 + 25e-8 + 2.0 * 4e-8;
    double expected = volume * (0.5 * lambda * trace * trace + mu * squares);
    for (int hand = -1; hand <= 1; hand += 2) {
        double points[ELEMENT_MOST_NODES][3], mass;
        place_nodes(hand, points);
        /* rounding: 81^2 products of displacements that are mostly rigid motion */
        near_relative(energy(points, gradient, (const double[3]){1e-3, -2e-3, 3e-3}, &mass),
                      expected, 1e-9);
        near_relative(mass, 2700.0 * volume, 1e-12);
    }
}

static void refuses_what_folds(void **state)
{
    (void)state;
    static double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS], mass[BRICK_NODES][BRICK_NODES];
    double points[ELEMENT_MOST_NODES][3];
    place_nodes(1.0, points);
    /* a corner pulled through the middle */
    for (int c = 0; c < 3; c++)
        points[0][c] *= -0.5;
    assert_false(brick_matrices(points, &metal, stiffness, mass));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(has_uniform_strain),
        cmocka_unit_test(refuses_what_folds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
