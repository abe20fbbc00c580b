/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors tests/reference/spatial/patch.c: Hertz's elliptic contact, its exact law, finer the
 * nearer; what gives way besides; what is refused. */
#include <string.h>

#include "check.h"
#include "spatial/patch.h"

static const struct patch_input paper = {
    .materials = {{"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
                  {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0}},
    .curvature = {0.5 / 0.015, 0.5 / 0.006},
    .force = 250.0,
    .resolution = 3,
};

static void is_hertz(void **state)
{
    (void)state;
    struct patch patch;
    struct fault fault;
    assert_int_equal(patch_create(&paper, &patch, &fault), PERCUSS_OK);
    double k = patch.hertz.stiffness, mean = 0.0;
    near_relative(k, 7.74365e9, 1e-6);
    for (int i = 0; i < 20; i++) {
        /* from half of the largest indentation on: one and a half to three bricks on the short
         * semi-axis; nodes come into contact one by one, which ripples */
        double d = pow(250.0 / k, 2.0 / 3.0) * (0.5 + 0.025 * i);
        double ratio = patch_press(&patch, d, 0.0) / (k * pow(d, 1.5));
        near(ratio, 1.0, 0.01);
        mean += ratio / 20.0;
    }
    /* ripple averages out; what is left is the mesh's stiffness */
    near(mean, 1.0, 3e-3);
    /* in series with a spring: F = k (d - s F)^(3/2) of the same patch */
    double spring = 1e-8, total = 1.2e-5;
    double force = patch_press(&patch, total, spring);
    near_relative(patch_press(&patch, total - spring * force, 0.0), force, 1e-9);
    near(patch_press(&patch, -1e-6, 0.0), 0.0, 0.0);
    patch_free(&patch);
}

static void refuses(void **state)
{
    (void)state;
    struct patch patch;
    struct fault fault;
    struct patch_input input = paper;
    input.resolution = 1;
    assert_int_equal(patch_create(&input, &patch, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "resolution: 1: must be"));
    input = paper;
    input.force = 0.0;
    assert_int_equal(patch_create(&input, &patch, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "force: 0"));
    input = paper;
    input.curvature[0] = 100.0;
    assert_int_equal(patch_create(&input, &patch, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "curvature: 100"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_hertz),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
