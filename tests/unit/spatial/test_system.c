/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors tests/reference/spatial/system.c on a beam halved at the contact: rigid motion has no
 * forces, uniform strain its energy, the mass is the volume's. */
#include <string.h>

#include "check.h"
#include "spatial/system.h"

static const struct material metal = {"metal", 70e9, 0.33, 2700.0, INFINITY, 0.0};

static void has_uniform_strain(void **state)
{
    (void)state;
    struct shape shape = shape_beam(0.01, 0.1, 8, 1);
    struct refined mesh;
    struct system3 system;
    struct fault fault;
    assert_int_equal(refined_create(&shape, 2, &mesh, &fault), PERCUSS_OK);
    assert_int_equal(system3_create(&mesh, &metal, &system, &fault), PERCUSS_OK);
    size_t n = system.freedoms;
    double *u = calloc(n, sizeof *u), *f = calloc(n, sizeof *f);
    /* along z as a whole */
    for (size_t i = 0; i < system.nodes; i++)
        u[3 * i + 2] = 1e-3;
    system3_stiffness(&system, u, f);
    double most = 0.0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, fabs(f[i]));
    /* rounding of E h 1 mm, some 1e5 N */
    near(most, 0.0, 1e-7);
    near_relative(system3_mean(&system, u, 2), 1e-3, 1e-13);
    system3_mass(&system, u, f);
    double momentum = 0.0;
    for (size_t i = 0; i < n; i++)
        momentum += f[i];
    near_relative(momentum, 1e-3 * system.whole, 1e-12);
    /* stretched: E/2 per volume; halved bricks follow the circle better than the faces that they
     * hang on, which a strain feels to the share of volume in between */
    for (size_t i = 0; i < system.nodes; i++) {
        const double *p = system.points[i];
        u[3 * i] = 1e-3 * p[0];
        u[3 * i + 1] = -0.33e-3 * p[1];
        u[3 * i + 2] = -0.33e-3 * p[2];
    }
    system3_stiffness(&system, u, f);
    double energy = 0.0;
    for (size_t i = 0; i < n; i++)
        energy += 0.5 * u[i] * f[i];
    near_relative(energy, 0.5 * 70e9 * 1e-6 * system.whole / 2700.0, 1e-4);
    free(u);
    free(f);
    system3_free(&system);
    refined_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(has_uniform_strain)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
