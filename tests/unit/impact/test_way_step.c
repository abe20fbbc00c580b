/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/way_step.c for laws that have the rate in them (test_memory_step.c
 * has those that remember): Hunt and Crossley's law against its closed forms, and its energy. */
#include "unit/impact/toy_scene.h"

/* For one mass F = k d^n (1 + c v) gives v dv / (1 + c v) = -w k d^n dd: what v - log(1 + c v)/c is
 * at the touch it is again where d = 0, for every n and k. The rebound u > 0 by bisection. */
static double rebound_of(double c, double speed)
{
    double low = 0.0, high = fmin(speed, 1.0 / c);
    for (;;) {
        double u = 0.5 * (low + high);
        if (!(u > low && u < high))
            return u;
        if (-u - log1p(-c * u) / c < speed - log1p(c * speed) / c)
            low = u;
        else
            high = u;
    }
}

static void balls_rebound_by_the_closed_form(void **state)
{
    (void)state;
    static const double exponents[] = {1.0, 1.5, 2.2};
    for (size_t i = 0; i < 3; i++)
        for (double c = 0.01; c < 40.0; c *= 6.0) {
            struct toy toy;
            toy_init(&toy, 1);
            toy.laws[0] = contact_law_dissipative(3.0, exponents[i], c);
            toy.gap_rate[0] = -0.7;
            assert_false(impact_is_rigid_pair(&toy.scene));
            struct impact_outcome fine = toy_run(&toy, 1e-9, 1e3), rough = toy_run(&toy, 1e-3, 1e3);
            double u = rebound_of(c, 0.7);
            const struct sub_impact *blow = &fine.tracks[0].list[0];
            assert_int_equal(fine.tracks[0].count, 1);
            /* the steps' error is some 0.1 accuracy^0.8 (modal.c) */
            measured("rebound", fine.motion.gap_rate[0], u, 7e-9);
            measured("with rough steps", rough.motion.gap_rate[0], u, 4e-4);
            measured("lost", fine.energy.damping, 0.5 * (0.49 - u * u), 7e-9);
            measured("closure", fine.energy.closure, 0.0, 1e-12);
            assert_true(blow->end > blow->compression_end && blow->peak_force > 0.0);
            toy_free(&toy);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_rebound_by_the_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
