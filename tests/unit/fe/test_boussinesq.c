/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/boussinesq.c: stresses from the displacements by Hooke's law and differences,
 * the load they carry, a free surface. */
#include "check.h"
#include "fe/boussinesq.h"

static void stress_follows_displacement(void **state)
{
    (void)state;
    const double young = 70.0, poisson = 0.33, h = 1e-5;
    struct material material = {"m", young, poisson, 1.0, INFINITY, 0.0};
    struct plastic_law law = plastic_law_make(&material);
    static const double points[][2] = {{0.7, -0.3}, {0.2, -1.1}, {1.3, -0.01}, {0.01, -0.8}};
    for (size_t i = 0; i < 4; i++) {
        double r = points[i][0], z = points[i][1], here[2], right[2], left[2], up[2], down[2];
        boussinesq_displacement(young, poisson, r, z, here);
        boussinesq_displacement(young, poisson, r + h, z, right);
        boussinesq_displacement(young, poisson, r - h, z, left);
        boussinesq_displacement(young, poisson, r, z + h, up);
        boussinesq_displacement(young, poisson, r, z - h, down);
        double strain[4] = {(right[0] - left[0]) / (2.0 * h), (up[1] - down[1]) / (2.0 * h),
                            here[0] / r, (up[0] - down[0] + right[1] - left[1]) / (2.0 * h)};
        double moduli[16], stress[4];
        plastic_law_moduli(&law, moduli);
        boussinesq_stress(poisson, r, z, stress);
        for (size_t c = 0; c < 4; c++) {
            double sum = 0.0;
            for (size_t d = 0; d < 4; d++)
                sum += moduli[4 * c + d] * strain[d];
            assert_true(fabs(sum - stress[c]) < 1e-6);
        }
    }
}

static void carries_one_newton(void **state)
{
    (void)state;
    double sum = 0.0, stress[4];
    for (double r = 0.005; r < 400.0; r += 0.01) {
        boussinesq_stress(0.3, r, -1.0, stress);
        sum += stress[1] * 2.0 * M_PI * r * 0.01;
    }
    assert_true(fabs(sum + 1.0) < 1e-4);
    boussinesq_stress(0.3, 0.4, 0.0, stress);
    assert_true(stress[1] == 0.0 && stress[3] == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stress_follows_displacement),
        cmocka_unit_test(carries_one_newton),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
