/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/quad.c: patch test, rank, volume, thick tube of incompressible
 * material. */
#include <string.h>

#include "check.h"
#include "fe/quad.h"
#include "numeric/linear.h"

static const struct material aluminium = {"al", 70e9, 0.33, 2700.0, INFINITY, 0.0};
static const double skewed_r[4] = {1.0, 1.9, 2.1, 0.8};
static const double skewed_z[4] = {0.1, -0.2, 0.9, 1.2};

/* nine nodes, the middle one off centre */
static const double patch[9][2] = {{1.0, 0.0}, {1.6, 0.0}, {2.0, 0.0}, {1.0, 0.4}, {1.4, 0.6},
                                   {2.0, 0.5}, {1.0, 1.0}, {1.5, 1.0}, {2.0, 1.0}};
static const int quads[4][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}};

/* u_r = a r, u_z = b z + c is uniform stress: the middle node is in equilibrium */
static void uniform_strain_needs_no_force_inside(void **unused)
{
    (void)unused;
    double a = 1e-3, b = -2e-3, c = 0.5;
    double force[9][2] = {{0.0}};
    double largest = 0.0;
    for (int e = 0; e < 4; e++) {
        double r[4], z[4], k[8][8];
        struct quad quad;
        for (int i = 0; i < 4; i++) {
            r[i] = patch[quads[e][i]][0];
            z[i] = patch[quads[e][i]][1];
        }
        assert_true(quad_make(r, z, &quad));
        quad_elastic_stiffness(&quad, &aluminium, k);
        for (int i = 0; i < 8; i++)
            for (int j = 0; j < 4; j++) {
                double f = k[i][2 * j] * a * r[j] + k[i][2 * j + 1] * (b * z[j] + c);
                force[quads[e][i / 2]][i % 2] += f;
                largest = fmax(largest, fabs(f));
            }
    }
    near_scaled(force[4][0], 0.0, largest, 1e-11);
    near_scaled(force[4][1], 0.0, largest, 1e-11);
}

/* moving along the axis is the only motion without energy: no hourglass modes */
static void only_translation_costs_nothing(void **unused)
{
    (void)unused;
    struct quad quad;
    double k[8][8], eigenvalue[8];
    assert_true(quad_make(skewed_r, skewed_z, &quad));
    quad_elastic_stiffness(&quad, &aluminium, k);
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < i; j++)
            near_scaled(k[i][j], k[j][i], k[0][0], 1e-12);
    assert_true(linear_symmetric_eigen(8, &k[0][0], eigenvalue));
    near_scaled(eigenvalue[0], 0.0, eigenvalue[7], 1e-14);
    for (int i = 1; i < 8; i++)
        assert_true(eigenvalue[i] > 1e-3 * eigenvalue[7]);
    for (int i = 0; i < 4; i++) {
        near_scaled(k[0][2 * i], 0.0, 1.0, 1e-10);
        near_scaled(fabs(k[0][2 * i + 1]), 0.5, 1.0, 1e-10);
    }
}

static void shares_are_the_solid_of_revolution(void **unused)
{
    (void)unused;
    struct quad quad;
    double share[4];
    double moment = 0.0, sum = 0.0;
    for (int i = 0; i < 4; i++) { /* Green's theorem: the integral of r over the quadrilateral */
        int k = (i + 1) % 4;
        moment += (skewed_r[i] + skewed_r[k]) *
                  (skewed_r[i] * skewed_z[k] - skewed_r[k] * skewed_z[i]) / 6.0;
    }
    assert_true(quad_make(skewed_r, skewed_z, &quad));
    quad_shares(&quad, share);
    for (int i = 0; i < 4; i++) {
        assert_true(share[i] > 0.0);
        sum += share[i];
    }
    near_scaled(sum, 2.0 * M_PI * moment, sum, 1e-13);
}

/* a rectangle 1 <= r <= 3, 0 <= z <= 1 with u_r = r z and u_z = r: slopes and hoop strain known */
static void slopes_are_those_of_the_field(void **unused)
{
    (void)unused;
    static const double r[4] = {1.0, 3.0, 3.0, 1.0}, z[4] = {0.0, 0.0, 1.0, 1.0};
    struct quad quad;
    double dilatation[8];
    double mean = 0.0, volume = 0.0, expected = 0.0;
    assert_true(quad_make(r, z, &quad));
    quad_dilatation(&quad, dilatation);
    for (int p = 0; p < QUAD_POINTS; p++) {
        double slope[4][3], ur_r = 0.0, ur_z = 0.0, hoop = 0.0, uz_r = 0.0, at_r = 0.0;
        quad_slopes(&quad, p, slope);
        for (int a = 0; a < 4; a++) {
            ur_r += slope[a][0] * r[a] * z[a];
            ur_z += slope[a][1] * r[a] * z[a];
            hoop += slope[a][2] * r[a] * z[a];
            uz_r += slope[a][0] * r[a];
            at_r += slope[a][2]; /* 1/r */
        }
        near_scaled(1.0 / at_r, p == 0 || p == 3 ? 2.0 - sqrt(1.0 / 3.0) : 2.0 + sqrt(1.0 / 3.0),
                    1.0, 1e-13);
        near_scaled(ur_z, 1.0 / at_r, 1.0, 1e-13);
        near_scaled(hoop, ur_r, 1.0, 1e-13); /* both are z */
        near_scaled(uz_r, 1.0, 1.0, 1e-13);
        expected += quad.volume[p] * (ur_r + hoop);
        volume += quad.volume[p];
    }
    for (int a = 0; a < 4; a++)
        mean += dilatation[2 * a] * r[a] * z[a] + dilatation[2 * a + 1] * r[a];
    near_scaled(mean, expected / volume, mean, 1e-13);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_strain_needs_no_force_inside),
        cmocka_unit_test(only_translation_costs_nothing),
        cmocka_unit_test(shares_are_the_solid_of_revolution),
        cmocka_unit_test(slopes_are_those_of_the_field),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
