/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/track.c: sub-impacts from steps, their peaks, and lists that
 * overflow. */
#include "impact/track.h"
#include "unit/impact/toy_scene.h"

/* Feeds half a sine of a period of 2, of `steps` steps, indentation and force alike. */
static void feed_sine(struct track *track, int steps)
{
    double h = 1.0 / steps;
    for (int n = 0; n < steps; n++) {
        double values[NODES];
        for (int j = 0; j < NODES; j++)
            values[j] = sin(M_PI * (n + collocation.node[j]) * h);
        struct track_values step = {sin(M_PI * n * h), sin(M_PI * (n + 1) * h), values, values,
                                    values};
        track_step(track, 5.0 + n * h, h, &step);
    }
}

static void follows_half_a_sine(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct track track;
    struct contact_law law = contact_law_linear(2.0);
    assert_true(track_create(&track, &arena));
    for (int steps = 4; steps <= 7; steps++) {
        track_clear(&track);
        track_open(&track, 5.0, -0.3);
        feed_sine(&track, steps);
        track_close(&track, &law, 6.0, 0.2);
        const struct sub_impact *sub = track.list;
        assert_int_equal(track.count, 1);
        near(sub->start, 5.0, 0.0);
        near(sub->end, 6.0, 0.0);
        near(sub->gap_rate_before, -0.3, 0.0);
        near(sub->gap_rate_after, 0.2, 0.0);
        /* Gauss of order 8: (pi/4)^9/9!/... */
        near(sub->impulse, 2.0 / M_PI, 1e-9);
        near(track.impulse, sub->impulse, 0.0);
        near(track.end_time, 6.0, 0.0);
        /* interpolation of a sine over a step of pi/4 */
        near(sub->max_indentation, 1.0, 1e-4);
        near(sub->peak_force, 2.0 * sub->max_indentation, 1e-15);
        near(sub->compression_end, 5.5, 1e-3);
        near(sub->compression_impulse, 1.0 / M_PI, 1e-3);
        /* integral of the squared slope of sin(pi t), by cubics */
        near(track.inertia, 0.5 * M_PI * M_PI, 2e-2);
        near(track.viscosity, 0.5 * M_PI * M_PI, 2e-2);
    }
    arena_release(&arena);
}

/* A parabola is within every interpolation: exact peak wherever it lies, at step ends too. */
static void finds_the_peak_of_a_parabola_exactly(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct track track;
    struct contact_law law = contact_law_linear(1.0);
    assert_true(track_create(&track, &arena));
    for (double peak = 0.25; peak < 2.8; peak += 0.125) {
        track_clear(&track);
        track_open(&track, 0.0, -1.0);
        for (int n = 0; n < 3; n++) {
            double values[NODES];
            for (int j = 0; j < NODES; j++) {
                double t = n + collocation.node[j] - peak;
                values[j] = 10.0 - t * t;
            }
            struct track_values step = {10.0 - (n - peak) * (n - peak),
                                        10.0 - (n + 1 - peak) * (n + 1 - peak), values, values,
                                        values};
            track_step(&track, n, 1.0, &step);
        }
        track_close(&track, &law, 3.0, 1.0);
        near(track.list[0].max_indentation, 10.0, 1e-13);
        /* a flat top: the root of the rounding */
        near(track.list[0].compression_end, peak, 1e-6);
        near(track.list[0].compression_impulse, 10.0 * peak - peak * peak * peak / 3.0, 1e-5);
        near(track.impulse, 30.0 - (pow(3.0 - peak, 3.0) + peak * peak * peak) / 3.0, 1e-13);
    }
    arena_release(&arena);
}

/* Constant, rising, falling: the largest value is where it is. */
static void knows_monotonous_steps(void **state)
{
    (void)state;
    static const double slopes[] = {0.0, 1.0, -1.0};
    struct arena arena = {0};
    struct track track;
    struct contact_law law = contact_law_linear(1.0);
    assert_true(track_create(&track, &arena));
    for (int i = 0; i < 3; i++) {
        double values[NODES];
        for (int j = 0; j < NODES; j++)
            values[j] = 2.0 + slopes[i] * collocation.node[j];
        struct track_values step = {2.0, 2.0 + slopes[i], values, values, values};
        track_clear(&track);
        track_open(&track, 0.0, -1.0);
        track_step(&track, 0.0, 1.0, &step);
        track_close(&track, &law, 1.0, 1.0);
        near(track.list[0].max_indentation, i == 1 ? 3.0 : 2.0, 1e-12);
        near(track.impulse, 2.0 + 0.5 * slopes[i], 1e-14);
    }
    arena_release(&arena);
}

static void counts_beyond_the_list(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct track track;
    struct contact_law law = contact_law_linear(1.0);
    assert_true(track_create(&track, &arena));
    double values[NODES] = {1.0, 1.0, 1.0, 1.0};
    struct track_values step = {1.0, 1.0, values, values, values};
    for (int i = 0; i < 300; i++) {
        track_open(&track, i, -1.0);
        /* the first weighs as much as all, one in ten next to nothing */
        double h = i == 0 ? 300.0 : i % 10 ? 1.0 : 1e-3;
        track_step(&track, i, h, &step);
        track_close(&track, &law, i + 0.5, 1.0);
    }
    assert_int_equal(track.count, 300);
    near(track.impulse, 300.0 + 270.0 + 29e-3, 1e-10);
    near(track.end_time, 299.5, 0.0);
    track_mark_negligible(&track);
    assert_false(track.list[0].negligible);
    for (int i = 1; i < PERCUSS_MAX_SUB_IMPACTS; i++)
        assert_true(track.list[i].negligible); /* 1 of 570 */
    near(track.list[PERCUSS_MAX_SUB_IMPACTS - 1].start, PERCUSS_MAX_SUB_IMPACTS - 1.0, 0.0);
    track_clear(&track);
    assert_int_equal(track.count, 0);
    near(track.impulse, 0.0, 0.0);
    arena_release(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_half_a_sine),
        cmocka_unit_test(finds_the_peak_of_a_parabola_exactly),
        cmocka_unit_test(knows_monotonous_steps),
        cmocka_unit_test(counts_beyond_the_list),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
