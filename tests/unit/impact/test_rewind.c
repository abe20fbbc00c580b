/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/march.c: parabolas by their closed roots, one oscillator by arc
 * cosine, many of them by dense samples; and how much work that takes. */
#include "impact/march.h"
#include "unit/impact/toy_scene.h"

/* Approach -gap - rate t + cos(omega t) by one mode of unit amplitude that starts at its far end.
 */
static void ring(struct toy *toy, double omega, double gap, double rate)
{
    const double shape = -1.0, q = 1.0, v = 0.0;
    toy_init(toy, 1);
    toy->gap[0] = gap;
    toy->gap_rate[0] = rate;
    toy_ring(toy, toy_add(toy, 0, 1, &omega, 0.0, &shape), &q, &v);
}

static void start(struct toy *toy, struct motion *motion)
{
    assert_true(motion_create(motion, &toy->scene, &toy->arena));
    motion_start(motion, &toy->scene);
}

enum { AMPLE = 1000000 };

static double back(struct toy *toy, const struct motion *motion, double longest)
{
    struct rewind rewind = {longest, AMPLE, &toy->arena, NULL, false};
    double time;
    enum rewind_end end = rewind_find(&rewind, &toy->scene, motion, 0, &time);
    assert_true(end == REWIND_TOUCHED || end == REWIND_NEVER);
    return end == REWIND_TOUCHED ? time : -INFINITY;
}

static void finds_the_touch_behind(void **state)
{
    (void)state;
    static const struct {
        double gap, rate, acceleration, expected;
    } cases[] = {
        {-0.1, -2.0, 0.0, -0.05},
        {-0.1, -2.0, 3.0, -0.048214}, /* was faster */
        {-0.1, -2.0, -3.0, -0.052},   /* was slower: the nearer root */
        {-0.1, 2.0, 0.0, -INFINITY},  /* opening: overlapped ever more before */
        {-1.0, -2.0, -3.0, -INFINITY} /* turned inside */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct toy toy;
        struct motion motion;
        toy_init(&toy, 1);
        toy.gap[0] = cases[i].gap;
        toy.gap_rate[0] = cases[i].rate;
        toy.gap_acceleration[0] = cases[i].acceleration;
        start(&toy, &motion);
        double t = back(&toy, &motion, 10.0);
        near(t, cases[i].expected, 1e-3);
        if (isfinite(t)) {
            double a = cases[i].acceleration;
            near(cases[i].gap + t * (cases[i].rate + 0.5 * a * t), 0.0, 1e-16);
        }
        toy_free(&toy);
    }
}

/* With vibration: the latest instant before now at which the approach rose through zero. */
static void finds_the_touch_behind_a_ringing_body(void **state)
{
    (void)state;
    struct toy toy;
    struct motion motion;
    ring(&toy, 2.0, 0.5, 0.0); /* cos(2t) - 0.5: overlap of 0.5 now, since 2t = -acos(0.5) */
    start(&toy, &motion);
    near(back(&toy, &motion, 10.0), -0.5 * acos(0.5), 1e-15);
    toy_free(&toy);
    ring(&toy, 2.0, -1.5, 0.0); /* never apart */
    start(&toy, &motion);
    near(back(&toy, &motion, 10.0), -INFINITY, 0.0);
    toy_free(&toy);
    ring(&toy, 2.0, -1.5, -0.3); /* 1.5 + 0.3 t + cos(2t) at t < 0 */
    start(&toy, &motion);
    double t = back(&toy, &motion, 20.0);
    near(1.5 + 0.3 * t + cos(2.0 * t), 0.0, 1e-14);
    /* it rises there, and stays positive from there to now */
    assert_true(0.3 - 2.0 * sin(2.0 * t) > 0.0);
    for (double s = t + 1e-6; s < 0.0; s += 1e-4)
        assert_true(1.5 + 0.3 * s + cos(2.0 * s) > 0.0);
    toy_free(&toy);
}

/* Sixty modes up to 1 Mrad/s with the amplitudes of a struck beam, over 20 ms: the touch that dense
 * samples find, by some dozens of intervals. Following the fastest mode takes 40000. */
static void many_modes_are_passed_by_bounds(void **state)
{
    (void)state;
    enum { MODES = 60 };
    double omega[MODES], shape[MODES], q[MODES], v[MODES];
    uint64_t seed = 5;
    unsigned long most = 0, found = 0;
    for (int trial = 0; trial < 60; trial++) {
        struct toy toy;
        struct motion motion;
        toy_init(&toy, 1);
        toy.gap_rate[0] = -0.01 * (1 + trial % 20);
        toy.gap_acceleration[0] = trial % 3 ? -9.81 : 0.0;
        for (int k = 0; k < MODES; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            double phase = (double)(seed >> 11) * 0x1p-53 * 2.0 * M_PI;
            omega[k] = 1e6 * pow((k + 1.0) / MODES, 2.0);
            shape[k] = 1.0;
            q[k] = 2e-5 * cos(phase) / ((k + 1.0) * (k + 1.0));
            v[k] = 2e-5 * sin(phase) * omega[k] / ((k + 1.0) * (k + 1.0));
        }
        struct scene_group *group = toy_add(&toy, 0, MODES, omega, trial % 2 ? 0.02 : 0.0, shape);
        toy_ring(&toy, group, q, v);
        double d = 0.0, rate, t = 0.0;
        start(&toy, &motion);
        motion_approach(&motion, &toy.scene, 0, &d, &rate);
        toy.gap[0] = motion.gap[0] = d - 1e-6 * (1 + trial); /* overlaps by so much */
        struct rewind rewind = {0.02, AMPLE, &toy.arena, NULL, false};
        double touch;
        bool touched = rewind_find(&rewind, &toy.scene, &motion, 0, &touch) == REWIND_TOUCHED;
        for (d = 1.0; d > 0.0 && t > -0.02; t -= 1e-7)
            motion_approach_at(&motion, &toy.scene, 0, t - 1e-7, &d, &rate);
        assert_true(touched == (d <= 0.0));
        if (touched) {
            assert_true(fabs(touch - t) <= 1.01e-7);
            motion_approach_at(&motion, &toy.scene, 0, touch, &d, &rate);
            near(d, 0.0, 1e-17);
            found++;
        }
        unsigned long taken = AMPLE - rewind.intervals;
        most = taken > most ? taken : most;
        /* the way is not cut short without saying so */
        struct rewind poor = {0.02, taken > 1 ? taken / 2 : 1, &toy.arena, NULL, false};
        if (taken > 2)
            assert_int_equal(rewind_find(&poor, &toy.scene, &motion, 0, &touch), REWIND_LIMIT);
        toy_free(&toy);
    }
    assert_true(found > 30);
    if (most > 300)
        fail_msg("%lu intervals", most);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_the_touch_behind),
        cmocka_unit_test(finds_the_touch_behind_a_ringing_body),
        cmocka_unit_test(many_modes_are_passed_by_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
