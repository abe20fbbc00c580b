/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/midpoint.c: modes carried through steps of any lengths, some of them
 * not taken, against the same steps by motion_step and motion_push. */
#include "impact/kernel.h"
#include "impact/midpoint.h"
#include "unit/impact/toy_scene.h"

enum { MODES = 5, STEPS = 12 };

static const double omegas[MODES] = {3.0, 20.0, 55.0, 130.0, 400.0};
static const double shapes[2 * MODES] = {0.6, -0.4, 0.3, 0.2, 0.5, -0.3, 0.9, 0.1, -0.7, 0.4};
/* the same length, half, twice, and by more */
static const int levels[STEPS] = {7, 7, 8, 7, 6, 6, 9, 9, 5, 6, 7, 7};

static void make(struct toy *toy, size_t contacts)
{
    static const double q[MODES] = {0.1, -0.2, 0.03, 0.01, -0.02}, v[MODES] = {-1.0, 2.0, 0.5};
    toy_init(toy, contacts);
    toy->gap[0] = -0.5;
    toy->gap_rate[0] = -0.3;
    toy->gap_acceleration[0] = -0.2;
    toy_ring(toy, toy_add(toy, 0, MODES, omegas, 0.0, shapes), q, v);
    toy_ring(toy, toy_add(toy, 1, MODES - 1, omegas, 0.03, shapes + 1), v, q);
    for (size_t g = 0; g < 2; g++)
        for (int level = 5; level < 10; level++)
            assert_non_null(oscillators_table(toy->groups[g].set, level));
}

/* Rounding of some hundred turns of modes of order one. */
#define agrees(value, expected) near(value, expected, 1e-13 * (1.0 + fabs(expected)))

static void check_sums(const struct toy *toy, const struct motion *motion, int level,
                       double (*sums)[STEP_POINTS])
{
    for (size_t c = 0; c < toy->scene.contacts; c++) {
        double expected[STEP_POINTS] = {0.0};
        for (size_t g = 0; g < 2; g++)
            kernel_nodes(toy->groups[g].set->tables[level], toy->groups[g].stride,
                         toy->groups[g].participation[c], motion->q[g], motion->v[g], expected);
        for (int i = 0; i < STEP_POINTS; i++)
            agrees(sums[c][i], expected[i]);
    }
}

static void check_motion(const struct toy *toy, const struct motion *motion,
                         const struct motion *expected)
{
    near(motion->time, expected->time, 0.0);
    for (size_t c = 0; c < toy->scene.contacts; c++) {
        agrees(motion->gap[c], expected->gap[c]);
        agrees(motion->gap_rate[c], expected->gap_rate[c]);
    }
    for (size_t g = 0; g < 2; g++)
        for (size_t k = 0; k < toy->groups[g].stride; k++) {
            agrees(motion->q[g][k], expected->q[g][k]);
            /* modes of order one have speeds of order omega */
            near(motion->v[g][k], expected->v[g][k], 1e-13 * omegas[MODES - 1]);
        }
}

static void carries_as_the_motion_goes(void **state)
{
    (void)state;
    for (size_t contacts = 1; contacts <= 2; contacts++) {
        struct toy toy;
        struct midpoint midpoint;
        struct motion motion, expected;
        double sums[2][STEP_POINTS], force[2][NODES] = {{0.0}};
        make(&toy, contacts);
        assert_true(midpoint_create(&midpoint, &toy.scene, &toy.arena));
        assert_true(motion_create(&motion, &toy.scene, &toy.arena));
        assert_true(motion_create(&expected, &toy.scene, &toy.arena));
        motion_start(&motion, &toy.scene);
        motion_start(&expected, &toy.scene);
        for (int n = 0; n < STEPS; n++) {
            int level = levels[n];
            /* every third step is tried with another length first, every fourth begins anew */
            if (n % 3 == 2)
                midpoint_enter(&midpoint, &toy.scene, &motion, levels[n - 1], sums);
            midpoint_enter(&midpoint, &toy.scene, &motion, level, sums);
            check_sums(&toy, &expected, level, sums);
            for (int j = 0; j < NODES; j++) {
                force[0][j] = 1.0 + 0.3 * n - 0.7 * j;
                force[1][j] = n % 2 ? 0.4 * j : 0.0;
            }
            midpoint_take(&midpoint, &toy.scene, &motion, force);
            motion_step(&expected, &expected, &toy.scene, level);
            motion_push(&expected, &toy.scene, level, force);
            if (n % 4 == 3) {
                midpoint_leave(&midpoint, &toy.scene, &motion);
                check_motion(&toy, &motion, &expected);
            }
        }
        /* a step that is not taken leaves no trace, nor do two ends */
        midpoint_enter(&midpoint, &toy.scene, &motion, 8, sums);
        midpoint_leave(&midpoint, &toy.scene, &motion);
        midpoint_leave(&midpoint, &toy.scene, &motion);
        check_motion(&toy, &motion, &expected);
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(carries_as_the_motion_goes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
