/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors the shapes of tests/reference/spatial/refined.c: the contact is where it is said to be,
 * the surfaces lie on beam and sphere, and blocks meet: no volume is missing or there twice. */
#include "check.h"
#include "spatial/system.h"

static const struct material unit = {"unit", 1.0, 0.3, 1.0, INFINITY, 0.0};

static double volume_of(const struct shape *shape)
{
    struct refined mesh;
    struct system3 system;
    struct fault fault;
    assert_int_equal(refined_create(shape, 0, &mesh, &fault), PERCUSS_OK);
    assert_int_equal(system3_create(&mesh, &unit, &system, &fault), PERCUSS_OK);
    double volume = system.whole;
    system3_free(&system);
    refined_free(&mesh);
    return volume;
}

static void is_the_body(void **state)
{
    (void)state;
    /* quadratic arcs cut off what falls with the fourth power of their angle */
    double beam = 0.25 * M_PI * 1e-4 * 0.1, sphere = M_PI / 3.0 * 3.375e-6, error[2][2];
    for (size_t across = 1; across <= 2; across++) {
        struct shape a = shape_beam(0.01, 0.1, 8 * across, across);
        double side = 0.006 / (double)across;
        struct shape b = shape_sphere(0.015, (const double[2]){side, side},
                                      (const size_t[3]){across, across, across});
        error[0][across - 1] = 1.0 - volume_of(&a) / beam;
        error[1][across - 1] = 1.0 - volume_of(&b) / sphere;
    }
    for (int body = 0; body < 2; body++) {
        near(error[body][0], 0.0, 1e-2);
        /* sixteen times less, or nearly so on coarse bricks */
        near(error[body][1] / error[body][0], 1.0 / 16.0, 0.06);
    }
}

static void touches_at_the_origin(void **state)
{
    (void)state;
    struct shape beam = shape_beam(0.01, 0.1, 8, 1);
    struct shape sphere = shape_sphere(0.015, beam.brick, (const size_t[3]){1, 1, 1});
    for (int i = 0; i <= 10; i++)
        for (int j = 0; j <= 10; j++) {
            double at[3] = {0.1 * i, 0.1 * j, 1.0}, place[3];
            beam.map(&beam, 0, at, place);
            near(hypot(place[1], place[2] + 0.01), 0.01, 1e-17);
            near(place[0], 0.05 * at[0], 1e-17);
            sphere.map(&sphere, 0, at, place);
            near(hypot(hypot(place[0], place[1]), place[2] - 0.015), 0.015, 1e-17);
            /* bricks of the beam's size */
            near(place[0], beam.brick[0] * at[0], 1e-17);
            near(place[1], beam.brick[1] * at[1], 1e-17);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_the_body),
        cmocka_unit_test(touches_at_the_origin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
