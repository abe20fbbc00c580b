/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/way_step.c for laws that have the rate in them (test_memory_step.c
 * has those that remember): Hunt and Crossley's law against its closed forms, and its energy. */
#include "model/relaxation.h"
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

/* Uniform in 0..1, always the same ones. */
static double draw(void)
{
    static unsigned long long at = 12345;
    at = at * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(at >> 11) * 0x1p-53;
}

/* Random bodies with modes, and a compliance in series of either sign, by both methods: a law with
 * the rate in it, and one that remembers. */
static void cvode_finds_the_same(void **state)
{
    (void)state;
    for (size_t i = 0; i < 6; i++) {
        struct toy toy;
        const struct relaxation relaxation = {
            2, {0.2 + 0.2 * draw(), 0.1 + 0.3 * draw()}, {0.1 + draw(), 1.5 + 6.0 * draw()}};
        double omega[3], phi[3];
        for (size_t k = 0; k < 3; k++) {
            omega[k] = ((double)k + 1.0) * (0.4 + draw());
            phi[k] = 1.2 * draw() - 0.3;
        }
        toy_init(&toy, 1);
        toy_add(&toy, 0, 3, omega, 0.01, phi);
        toy.laws[0] = i % 2 ? contact_law_viscoelastic(1.0, &relaxation)
                            : contact_law_dissipative(1.0, 1.0 + draw(), 0.1 + draw());
        toy.residual[0] = 0.1 * draw() - 0.04;
        toy.gap_rate[0] = -1.0;
        struct impact_outcome modal = toy_run(&toy, 1e-10, 100.0);
        struct impact_outcome cvode = toy_cvode(&toy, 1e-10, 100.0);
        const struct track *a = &modal.tracks[0], *b = &cvode.tracks[0];
        assert_int_equal(a->count, 1);
        assert_int_equal(b->count, 1);
        /* the modal method's steps, of several blows a contact, leave up to 6e-9 */
        measured("restitution", modal.motion.gap_rate[0], cvode.motion.gap_rate[0], 7e-9);
        measured("lost", modal.relaxed, cvode.relaxed, 7e-9);
        measured("closure", modal.energy.closure, 0.0, 1e-10);
        measured("closure of cvode", cvode.energy.closure, 0.0, 1e-9);
        measured("end", a->list[0].end, b->list[0].end, 1e-5);
        /* cvode's is the largest at its steps */
        measured("peak", a->list[0].peak_force, b->list[0].peak_force, 1e-4);
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_rebound_by_the_closed_form),
        cmocka_unit_test(cvode_finds_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
