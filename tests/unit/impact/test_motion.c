/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/motion.c and scene.c: the state between contacts and its exact
 * motion. */
#include "impact/oscillator.h"
#include "unit/impact/toy_scene.h"

static const double omegas[] = {50.0, 400.0, 9e3};
static const double shapes[] = {1.0, -0.5, 0.25, 0.0, 2.0, -1.0}; /* two contacts */
static const double q0[] = {1e-3, -2e-4, 3e-6};
static const double v0[] = {0.01, 0.0, -0.02};

static void make(struct toy *toy, double damping)
{
    toy_init(toy, 2);
    struct scene_group *group = toy_add(toy, 1, 3, omegas, damping, shapes);
    toy_ring(toy, group, q0, v0);
    toy->gap[0] = 0.002;
    toy->gap_rate[0] = -0.3;
    toy->gap_acceleration[0] = 9.0;
    toy->gap[1] = -0.001;
}

static void starts_as_stated(void **state)
{
    (void)state;
    struct toy toy;
    struct motion motion, copy;
    double d, rate;
    make(&toy, 0.0);
    assert_true(motion_create(&motion, &toy.scene, &toy.arena));
    assert_true(motion_create(&copy, &toy.scene, &toy.arena));
    motion_start(&motion, &toy.scene);
    motion_approach(&motion, &toy.scene, 0, &d, &rate);
    near(d, -0.002 - (1.0 * 1e-3 + 0.5 * 2e-4 + 0.25 * 3e-6), 1e-18);
    near(rate, 0.3 - (0.01 - 0.25 * 0.02), 1e-16);
    motion_approach(&motion, &toy.scene, 1, &d, &rate);
    near(d, 0.001 - (-2.0 * 2e-4 - 3e-6), 1e-18);
    motion_copy(&copy, &motion, &toy.scene);
    assert_memory_equal(copy.q[0], motion.q[0], 4 * sizeof(double));
    assert_true(copy.gap[1] == motion.gap[1] && copy.time == 0.0);
    double energy = 0.0;
    for (int k = 0; k < 3; k++)
        energy += 0.5 * (v0[k] * v0[k] + omegas[k] * omegas[k] * q0[k] * q0[k]);
    near(motion_vibration(&motion, &toy.scene, 1), energy, 1e-15 * energy);
    assert_true(motion_vibration(&motion, &toy.scene, 0) == 0.0);
    near(scene_highest_frequency(&toy.scene), 9e3, 0.0);
    near(scene_longest_period(&toy.scene), 2.0 * M_PI / 50.0, 1e-16);
    toy_free(&toy);
}

/* Moving and looking ahead are one; the oscillators move by their exact maps. */
static void moves_exactly(void **state)
{
    (void)state;
    struct toy toy;
    struct motion motion, start;
    make(&toy, 0.03);
    assert_true(motion_create(&motion, &toy.scene, &toy.arena));
    assert_true(motion_create(&start, &toy.scene, &toy.arena));
    motion_start(&start, &toy.scene);
    for (double t = 0.0; t < 0.02; t += 0.0013) {
        motion_copy(&motion, &start, &toy.scene);
        double loss = motion_free_loss(&motion, &toy.scene, t);
        double before = motion_vibration(&motion, &toy.scene, 1);
        motion_advance(&motion, &toy.scene, t);
        near(motion.gap[0], 0.002 - 0.3 * t + 4.5 * t * t, 1e-17);
        near(motion.gap_rate[0], -0.3 + 9.0 * t, 1e-16);
        near(motion.time, t, 0.0);
        for (int k = 0; k < 3; k++) {
            double q = q0[k], v = v0[k];
            oscillator_advance(omegas[k], 0.03, t, &q, &v);
            near(motion.q[0][k], q, 0.0);
            near(motion.v[0][k], v, 0.0);
        }
        for (size_t c = 0; c < 2; c++) {
            double now[2], ahead[2];
            motion_approach(&motion, &toy.scene, c, &now[0], &now[1]);
            motion_approach_at(&start, &toy.scene, c, t, &ahead[0], &ahead[1]);
            near(ahead[0], now[0], 1e-17);
            near(ahead[1], now[1], 1e-15);
        }
        near(before - motion_vibration(&motion, &toy.scene, 1), loss, 1e-13 * before);
    }
    toy_free(&toy);
}

/* All at once to rounding; modes that turn too often for that as one by one. */
static void turns_alike(void **state)
{
    (void)state;
    static const double times[] = {0.0, 1.3e-3, 0.7, 1e6};
    struct toy toy;
    struct motion motion, start;
    make(&toy, 0.03);
    assert_true(motion_create(&motion, &toy.scene, &toy.arena));
    assert_true(motion_create(&start, &toy.scene, &toy.arena));
    for (size_t i = 0; i < COUNT(times); i++) {
        motion_start(&start, &toy.scene);
        motion_copy(&motion, &start, &toy.scene);
        motion_advance(&start, &toy.scene, times[i]);
        motion_turn(&motion, &toy.scene, times[i]);
        near(motion.time, start.time, 0.0);
        near(motion.gap[1], start.gap[1], 0.0);
        near(motion.gap_rate[0], start.gap_rate[0], 0.0);
        for (int k = 0; k < 3; k++) {
            near(motion.q[0][k], start.q[0][k], 1e-13 * fabs(q0[k]));
            near(motion.v[0][k], start.v[0][k], 1e-13 * fabs(q0[k]) * omegas[k]);
        }
    }
    toy_free(&toy);
}

/* Back along the rigid motion and undamped vibration: the energy stays, undamped it is the inverse.
 */
static void rewinds_without_blowing_up(void **state)
{
    (void)state;
    for (int damped = 0; damped < 2; damped++) {
        struct toy toy;
        struct motion motion;
        make(&toy, damped ? 0.4 : 0.0);
        assert_true(motion_create(&motion, &toy.scene, &toy.arena));
        motion_start(&motion, &toy.scene);
        double energy = motion_vibration(&motion, &toy.scene, 1);
        double ahead[2], now[2];
        motion_approach_at(&motion, &toy.scene, 0, -0.5, &ahead[0], &ahead[1]);
        motion_rewind(&motion, &toy.scene, 0.5);
        near(motion.time, -0.5, 0.0);
        near(motion.gap[0], 0.002 + 0.15 + 4.5 * 0.25, 1e-15);
        near(motion.gap_rate[0], -0.3 - 4.5, 1e-15);
        /* phases of 4500 rad: 1e-12 of the energy */
        near(motion_vibration(&motion, &toy.scene, 1), energy, 1e-12 * energy);
        motion_approach(&motion, &toy.scene, 0, &now[0], &now[1]);
        near(ahead[0], now[0], 1e-15);
        near(ahead[1], now[1], 1e-13);
        if (!damped) {
            motion_advance(&motion, &toy.scene, 0.5);
            for (int k = 0; k < 3; k++)
                near(motion.q[0][k], q0[k], 1e-15);
            near(motion.gap[0], 0.002, 1e-15);
        }
        toy_free(&toy);
    }
}

static void a_scene_without_modes_has_no_frequency(void **state)
{
    (void)state;
    struct toy toy;
    toy_init(&toy, 1);
    assert_true(scene_highest_frequency(&toy.scene) == 0.0);
    assert_true(scene_longest_period(&toy.scene) == 0.0);
    toy_free(&toy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(starts_as_stated),
        cmocka_unit_test(moves_exactly),
        cmocka_unit_test(turns_alike),
        cmocka_unit_test(rewinds_without_blowing_up),
        cmocka_unit_test(a_scene_without_modes_has_no_frequency),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
