/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/fe/axi_element.c: patch test, rank, volume, thick tube of incompressible
 * material.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "fe/axi_element.h"
#include "numeric/linear.h"

static const struct material aluminium = {"al", 70e9, 0.33, 2700.0, INFINITY, 0.0};
static const double skewed[4][2] = {{1.0, 0.1}, {1.9, -0.2}, {2.1, 0.9}, {0.8, 1.2}};

static void near(double value, double expected, double scale, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(scale)))
        fail_msg("%.17g is not %.17g", value, expected);
}

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
        double at[4][2], k[8][8];
        struct axi_element element;
        for (int i = 0; i < 4; i++)
            memcpy(at[i], patch[quads[e][i]], sizeof at[i]);
        assert_true(axi_element_make(&element, at));
        axi_element_stiffness(&element, &aluminium, k);
        for (int i = 0; i < 8; i++)
            for (int j = 0; j < 4; j++) {
                double f = k[i][2 * j] * a * at[j][0] + k[i][2 * j + 1] * (b * at[j][1] + c);
                force[quads[e][i / 2]][i % 2] += f;
                largest = fmax(largest, fabs(f));
            }
    }
    near(force[4][0], 0.0, largest, 1e-11);
    near(force[4][1], 0.0, largest, 1e-11);
}

/* moving along the axis is the only motion without energy: no hourglass modes */
static void only_translation_costs_nothing(void **unused)
{
    (void)unused;
    struct axi_element element;
    double k[8][8], eigenvalue[8];
    assert_true(axi_element_make(&element, skewed));
    axi_element_stiffness(&element, &aluminium, k);
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < i; j++)
            near(k[i][j], k[j][i], k[0][0], 1e-12);
    assert_true(linear_symmetric_eigen(8, &k[0][0], eigenvalue));
    near(eigenvalue[0], 0.0, eigenvalue[7], 1e-14);
    for (int i = 1; i < 8; i++)
        assert_true(eigenvalue[i] > 1e-3 * eigenvalue[7]);
    for (int i = 0; i < 4; i++) {
        near(k[0][2 * i], 0.0, 1.0, 1e-10);
        near(fabs(k[0][2 * i + 1]), 0.5, 1.0, 1e-10);
    }
}

static void volume_is_the_solid_of_revolution(void **unused)
{
    (void)unused;
    struct axi_element element;
    double area = 0.0, moment = 0.0, sum = 0.0;
    for (int i = 0; i < 4; i++) { /* Green's theorem: integrals of 1 and r over the quadrilateral */
        const double *p = skewed[i];
        const double *q = skewed[(i + 1) % 4];
        area += 0.5 * (p[0] * q[1] - q[0] * p[1]);
        moment += (p[0] + q[0]) * (p[0] * q[1] - q[0] * p[1]) / 6.0;
    }
    assert_true(area > 0.0 && axi_element_make(&element, skewed));
    for (int i = 0; i < 4; i++) {
        assert_true(element.share[i] > 0.0);
        sum += element.share[i];
    }
    near(element.volume, 2.0 * M_PI * moment, element.volume, 1e-13);
    near(sum, element.volume, element.volume, 1e-13);
    double folded[4][2] = {{1.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}, {2.0, 0.0}};
    assert_false(axi_element_make(&element, folded));
}

/* Displacement of the inner wall of a long tube, radii 1 and 2, `count` elements of square section
 * between rigid ends, pressure 1 inside. */
static double tube_bore(int count, const struct material *material)
{
    enum { MOST = 64 };
    static double k[(MOST + 1) * (MOST + 1)];
    double u[MOST + 1] = {0.0};
    double height = 1.0 / count;
    memset(k, 0, sizeof k);
    for (int e = 0; e < count; e++) {
        double low = 1.0 + e * height;
        double at[4][2] = {{low, 0}, {low + height, 0}, {low + height, height}, {low, height}};
        double ke[8][8];
        struct axi_element element;
        assert_true(axi_element_make(&element, at));
        axi_element_stiffness(&element, material, ke);
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++) {
                int row = e + (i == 1 || i == 2);
                int column = e + (j == 1 || j == 2);
                k[row * (count + 1) + column] += ke[2 * i][2 * j];
            }
    }
    u[0] = 2.0 * M_PI * 1.0 * height;
    assert_true(linear_solve((size_t)count + 1, k, u));
    return u[0];
}

/* Lame: u(a) = p a (1 + nu)/E ((1 - 2 nu) a^2 + b^2) / (b^2 - a^2). Elements that lock would come
 * out stiffer by an order of magnitude at nu = 0.49999; these converge at second order. */
static void incompressible_tube_does_not_lock(void **unused)
{
    (void)unused;
    struct material rubber = {"rubber", 1.0, 0.49999, 1.0, INFINITY, 0.0};
    double exact = (1.0 + rubber.poisson) * ((1.0 - 2.0 * rubber.poisson) + 4.0) / 3.0;
    double coarse = fabs(tube_bore(8, &rubber) / exact - 1.0);
    double fine = fabs(tube_bore(16, &rubber) / exact - 1.0);
    assert_true(coarse < 0.01);
    near(coarse / fine, 4.0, 4.0, 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_strain_needs_no_force_inside),
        cmocka_unit_test(only_translation_costs_nothing),
        cmocka_unit_test(volume_is_the_solid_of_revolution),
        cmocka_unit_test(incompressible_tube_does_not_lock),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
