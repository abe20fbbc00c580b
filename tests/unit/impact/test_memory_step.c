/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/way_contact.c and memory_step.c, contact/memory.c and
 * contact/recovery.c: viscoelastic contacts against Prony's series where the indentation is held,
 * against the circles of the contact integrated one by one (Ting's rule without its parabola, and
 * free circles), and their energy. */
#include "impact/impact_scale.h"
#include "impact/way_contact.h"
#include "unit/impact/one_by_one.h"
#include "unit/impact/toy_scene.h"

/* A sudden indentation that is held: k d^(3/2) g(t), to rounding. */
static void a_held_contact_relaxes(void **state)
{
    (void)state;
    static const struct relaxation of = {2, {0.3, 0.4}, {0.2, 3.0}};
    const double held[STEP_POINTS] = {1.7, 1.7, 1.7, 1.7, 1.7};
    static const struct way_slopes none = {{{0.0}}};
    struct arena arena = {0};
    struct way_contact contact;
    const struct contact_law law = contact_law_viscoelastic(2.0, &of);
    assert_true(way_contact_create(&contact, &law, 0.0, &arena));
    double time = 0.0;
    for (int level = 6; level >= 0; level--) {
        assert_true(way_contact_prepare(&contact, level, &arena));
        memcpy(contact.indentation, held, sizeof held);
        way_contact_start(&contact, level);
        way_contact_forces(&contact, NULL, contact.force);
        for (int i = 0; i < STEP_POINTS; i++) {
            double t = time + step_length(level) * (i < NODES ? collocation.node[i] : 1.0);
            double g = 1.0 - 0.3 * -expm1(-t / 0.2) - 0.4 * -expm1(-t / 3.0);
            measured("force", contact.force[i], 2.0 * pow(1.7, 1.5) * g, 1e-14);
        }
        way_contact_take(&contact, &none, level, time, 1.7);
        time += step_length(level);
    }
    arena_release(&arena);
}

/* The modes of recovery are those of time_i m_i' = sum share m - m_i: differences of terms that
 * fade are those rates, and a load that stays adds its creep. */
static void free_circles_recover_by_modes(void **state)
{
    (void)state;
    static const struct relaxation of = {3, {0.2, 0.3, 0.3}, {0.1, 1.0, 8.0}};
    const struct recovery_modes modes = recovery_modes_make(&of);
    const double terms[RELAXATION_MOST] = {0.7, -0.2, 0.4}, h = 1e-4;
    double same[RELAXATION_MOST], later[2][RELAXATION_MOST], loaded[RELAXATION_MOST];
    struct recovery left = {.reach = 1.0};
    recovery_modes_split(&modes, terms, left.center);
    recovery_modes_join(&modes, left.center, same);
    for (int side = 0; side < 2; side++) {
        recovery_fade(&left, &modes, side ? 2.0 * h : -h);
        recovery_modes_join(&modes, left.center, later[side]);
    }
    recovery_modes_join(&modes, modes.driven, loaded);
    double u = 0.2 * 0.7 - 0.3 * 0.2 + 0.3 * 0.4;
    for (size_t i = 0; i < 3; i++) {
        near_relative(same[i], terms[i], 1e-13);
        /* central differences of the second order: (h/time)^2 / 6 */
        near_relative((later[1][i] - later[0][i]) / (2.0 * h), (u - terms[i]) / of.time[i], 1e-6);
        /* at rest under a load 1: m_i = u = sum share m + 1 */
        near_relative(loaded[i], 1.0 / 0.2, 1e-13);
    }
}

/* A surface that has fallen behind the ball in the middle bears nothing there, nor where it would
 * farther out: no edge, and none that a contact could turn at. */
static void what_is_below_in_the_middle_has_no_edge(void **state)
{
    (void)state;
    static const double falling[] = {-1e-3, -1.0, 0.2}, rising[] = {-1e-3, 1.0, -1.0},
                        pressed[] = {1e-3, -1.0, 0.0}, everywhere[] = {1e-3, 1.0, 1.0};
    assert_true(contact_memory_edge(-1.0, falling, 2.0) < 0.0);
    assert_true(contact_memory_edge(-1.0, rising, 2.0) < 0.0);
    near(contact_memory_edge(-1.0, pressed, 2.0), 1e-3, 1e-18);
    assert_true(contact_memory_edge(-1.0, everywhere, 2.0) == 2.0);
    assert_true(contact_memory_edge(3.0, rising, 2.0) == 3.0);
}

/* Steps are shares of the contact of a sudden force: 1/2 v^2 = 2/5 k d^(5/2) of a unit mass,
 * whatever comes back in the end. */
static void the_sudden_force_is_the_scale(void **state)
{
    (void)state;
    static const struct relaxation of = {2, {0.5, 0.4}, {0.2, 3.0}};
    struct toy toy;
    toy_init(&toy, 1);
    toy.laws[0] = contact_law_viscoelastic(2.0, &of);
    const struct impact_scale scale = impact_scale_of(&toy.scene, 0, -0.3);
    double d = pow(0.5 * 0.09 / (0.4 * 2.0), 0.4);
    near_relative(scale.indentation, d, 1e-12);
    near_relative(scale.duration, d / 0.3, 1e-12);
    near_relative(scale.force, 2.0 * d * sqrt(d), 1e-12);
    toy_free(&toy);
}

static double with_circles(const struct relaxation *of, const struct wall *wall)
{
    static const struct spin none = {0.0, 0.0, 0.0, 0.0};
    return one_by_one(of, 0.0, wall, &none).up;
}

static struct impact_outcome run(struct toy *toy, double accuracy)
{
    struct impact_outcome outcome;
    struct impact_settings settings = {.accuracy = accuracy, .horizon = 1e3, .max_work = 1e9};
    assert_true(impact_create(&outcome, &toy->scene, &toy->arena));
    assert_int_equal(impact_modal(&toy->scene, &settings, &toy->arena, &outcome), PERCUSS_OK);
    return outcome;
}

/* The energy of each step is exact; the restitution converges with the steps to that of Ting's rule
 * but for the parabola, which the circles have not (largest difference 0.0011; the circles' own
 * error is 1e-4). */
static void balls_rebound_by_tings_rule(void **state)
{
    (void)state;
    static const struct relaxation cases[] = {{1, {0.1}, {1.0}},
                                              {1, {0.3}, {0.5}},
                                              {1, {0.5}, {0.1}},
                                              {1, {0.5}, {3.0}},
                                              {1, {0.9}, {1.0}},
                                              {1, {0.98}, {0.5}},
                                              {3, {0.2, 0.3, 0.3}, {0.1, 1.0, 8.0}}};
    const struct wall rigid = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct toy toy;
        toy_init(&toy, 1);
        toy.laws[0] = contact_law_viscoelastic(1.0, &cases[i]);
        toy.gap_rate[0] = -1.0;
        assert_false(impact_is_rigid_pair(&toy.scene));
        struct impact_outcome fine = run(&toy, 1e-9), rough = run(&toy, 1e-3);
        const struct sub_impact *blow = &fine.tracks[0].list[0];
        double e = fine.motion.gap_rate[0], exact = with_circles(&cases[i], &rigid);
        print_message("share %.2f time %.1f: e %.6f, circles %.6f\n", cases[i].share[0],
                      cases[i].time[0], e, exact);
        assert_int_equal(fine.tracks[0].count, 1);
        measured("restitution", e, exact, 0.0013);
        measured("with rough steps", rough.motion.gap_rate[0], e, 1e-4);
        measured("closure", fine.energy.closure, 0.0, 1e-12);
        measured("lost", fine.energy.damping, 0.5 * (1.0 - e * e), 1e-12);
        measured("impulse", blow->impulse, 1.0 + e, 1e-12);
        /* the ball parts while the surface is still indented, at the end of its force */
        assert_true(blow->end > blow->compression_end && blow->end < fine.window);
        measured("parts", rough.tracks[0].list[0].end, blow->end, 0.02);
        toy_free(&toy);
    }
}

/* A ball on an oscillator of twice its mass, which hits it again after half a period: from within
 * the first contact (omega 1) to 16 durations later. What is left of the first blow is there. The
 * difference to the circles is what the parabolas leave, in the first blow too, which shifts the
 * second one. */
static void second_blows_find_a_surface_that_recovers(void **state)
{
    (void)state;
    static const struct relaxation of[] = {
        {1, {0.5}, {3.0}}, {1, {0.8}, {3.0}}, {3, {0.2, 0.3, 0.3}, {0.1, 1.0, 8.0}}};
    static const struct {
        size_t of, blows;
        double omega;
    } cases[] = {{0, 1, 1.0}, {0, 2, 0.5}, {1, 1, 1.0}, {1, 2, 0.5}, {2, 2, 0.5}, {2, 2, 0.2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct toy toy;
        const struct relaxation *relaxation = &of[cases[i].of];
        const struct wall wall = {cases[i].omega, 0.7, 1.4 * M_PI / cases[i].omega + 3.0};
        toy_init(&toy, 1);
        toy_add(&toy, 0, 1, &wall.omega, 0.0, &wall.phi);
        toy.laws[0] = contact_law_viscoelastic(1.0, relaxation);
        toy.gap_rate[0] = -1.0;
        struct impact_outcome fine = toy_run(&toy, 1e-9, 1e3), rough = toy_run(&toy, 1e-4, 1e3);
        struct impact_outcome cvode = toy_cvode(&toy, 1e-10, 1e3);
        double e = fine.motion.gap_rate[0], exact = with_circles(relaxation, &wall);
        print_message("share %.2f time %.1f omega %.1f: e %.6f, circles %.6f\n",
                      relaxation->share[0], relaxation->time[0], wall.omega, e, exact);
        assert_int_equal(fine.tracks[0].count, cases[i].blows);
        assert_true(fine.window < wall.until);
        assert_int_equal(cvode.tracks[0].count, cases[i].blows);
        /* the modal method meets turns of contacts that grow again at the ends of its steps */
        measured("by cvode", cvode.motion.gap_rate[0], e, 1e-7);
        measured("closure of cvode", cvode.energy.closure, 0.0, 1e-9);
        for (size_t b = 0; b < fine.tracks[0].count; b++) {
            const struct sub_impact *blow = &fine.tracks[0].list[b];
            assert_true(blow->end > blow->start);
            /* touches, partings and peaks to the length of the steps there */
            measured("start", blow->start, cvode.tracks[0].list[b].start, 1e-4);
            measured("end", blow->end, cvode.tracks[0].list[b].end, 1e-4);
            measured("peak", blow->peak_force, cvode.tracks[0].list[b].peak_force, 1e-4);
        }
        measured("restitution", e, exact, 0.0013);
        measured("with rough steps", rough.motion.gap_rate[0], e, 5e-5);
        measured("closure", fine.energy.closure, 0.0, 1e-12);
        toy_free(&toy);
    }
}

/* What comes back may pass the place of the surface at rest, and not touch what is left of it. */
static void what_does_not_touch_is_no_blow(void **state)
{
    (void)state;
    static const struct relaxation of = {1, {0.9}, {10.0}};
    static const double omega = 0.6214, phi = 0.7;
    struct toy toy;
    toy_init(&toy, 1);
    toy_add(&toy, 0, 1, &omega, 0.0, &phi);
    toy.laws[0] = contact_law_viscoelastic(1.0, &of);
    toy.gap_rate[0] = -1.0;
    struct impact_outcome modal = toy_run(&toy, 1e-9, 1e3), cvode = toy_cvode(&toy, 1e-10, 1e3);
    assert_int_equal(modal.tracks[0].count, 1);
    assert_int_equal(cvode.tracks[0].count, 1);
    measured("restitution", modal.motion.gap_rate[0], cvode.motion.gap_rate[0], 1e-7);
    toy_free(&toy);
}

/* Modes, a compliance in series and a load that presses, and the end of the window within the
 * contact: the energy closes. */
static void the_energy_closes_beside_modes(void **state)
{
    (void)state;
    static const struct relaxation of = {2, {0.2, 0.4}, {0.3, 2.0}};
    static const double omega[] = {1.3, 4.0, 9.0}, phi[] = {0.7, -0.5, 0.4};
    for (int held = 0; held < 2; held++) {
        struct toy toy;
        toy_init(&toy, 1);
        toy_add(&toy, 0, 3, omega, 0.02, phi);
        toy.laws[0] = contact_law_viscoelastic(1.0, &of);
        toy.residual[0] = 0.05;
        toy.gap_rate[0] = -1.0;
        toy.gap_acceleration[0] = held ? -0.2 : 0.0;
        struct impact_settings settings = {
            .accuracy = 1e-8, .horizon = held ? 2.0 : 1e3, .max_work = 1e9};
        struct impact_outcome outcome;
        assert_true(impact_create(&outcome, &toy.scene, &toy.arena));
        assert_int_equal(impact_modal(&toy.scene, &settings, &toy.arena, &outcome), PERCUSS_OK);
        assert_int_equal(outcome.end_reason == PERCUSS_END_IN_CONTACT, held);
        assert_true(outcome.relaxed > 0.0);
        measured("closure", outcome.energy.closure / outcome.energy.available, 0.0, 1e-7);
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_held_contact_relaxes),
        cmocka_unit_test(free_circles_recover_by_modes),
        cmocka_unit_test(what_is_below_in_the_middle_has_no_edge),
        cmocka_unit_test(the_sudden_force_is_the_scale),
        cmocka_unit_test(balls_rebound_by_tings_rule),
        cmocka_unit_test(second_blows_find_a_surface_that_recovers),
        cmocka_unit_test(what_does_not_touch_is_no_blow),
        cmocka_unit_test(the_energy_closes_beside_modes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
