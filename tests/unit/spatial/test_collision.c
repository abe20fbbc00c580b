/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors tests/reference/spatial/collision.c with moving.c: the first blow on a
 * coarse mesh against the modal solution, and the books of momentum and energy; what is refused. */
#include <string.h>

#include "check.h"
#include "spatial/collision.h"

static const struct pair_input paper = {
    .materials = {{"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
                  {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0}},
    .beam_radius = 0.01,
    .beam_length = 1.0,
    .sphere_radius = 0.015,
    .velocity = 0.2,
    .bricks = 80,
    .across = 1,
    .levels = 3,
};

static void strikes_first(void **state)
{
    (void)state;
    struct pair pair;
    struct collider collider;
    struct collision found;
    struct fault fault;
    assert_int_equal(pair_create(&paper, &pair, &fault), PERCUSS_OK);
    /* swollen radii make up for the corners that quadratic bricks cut off: exactly before they are
     * halved */
    near_relative(pair.mass[PAIR_BEAM], 2700.0 * M_PI * 1e-4, 1e-4);
    near_relative(pair.mass[PAIR_SPHERE], 7800.0 * 4.0 / 3.0 * M_PI * 3.375e-6, 1e-3);
    assert_int_equal(collider_create(&pair, 4e-6, 8e-6, &collider, &fault), PERCUSS_OK);
    struct collision_settings settings = {.horizon = 2.4e-4};
    const double approach = 0.2;
    assert_int_equal(collider_run(&collider, &settings, 1, &approach, &found, &fault), PERCUSS_OK);
    assert_int_equal(found.sub_impacts, 1);
    /* modal solutions, mesh and Timoshenko, have 19.508e-3 N s; nodes here are as far apart as a
     * third of the contact, which makes it softer: one per cent and a half */
    near_relative(found.sub_impact[0].impulse, 19.508e-3, 0.015);
    near(found.force, 0.0, 0.0);
    /* momentum: forces go linearly, as the steps take them */
    near_relative(pair.mass[PAIR_BEAM] * -found.speed[PAIR_BEAM], found.impulse, 1e-6);
    near_relative(pair.mass[PAIR_SPHERE] * (found.speed[PAIR_SPHERE] + 0.2), found.impulse, 1e-6);
    /* Radau's rule takes from waves that are fast for steps of 4 us, nodes lose what they close
     * with */
    near(found.available - found.rebound - found.vibration, 0.0, 2e-3 * found.available);
    collider_free(&collider);
    pair_free(&pair);
}

static void refuses(void **state)
{
    (void)state;
    struct pair pair;
    struct fault fault;
    struct pair_input input = paper;
    input.bricks = 3;
    assert_int_equal(pair_create(&input, &pair, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "bricks: 3: must be"));
    input.bricks = 20;
    assert_int_equal(pair_create(&input, &pair, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "bricks: 20: half of one must be"));
    input = paper;
    input.across = 9;
    assert_int_equal(pair_create(&input, &pair, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "across: 9: must be"));
    input = paper;
    input.levels = 0;
    assert_int_equal(pair_create(&input, &pair, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "levels: 0: must be"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strikes_first),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
