/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/impact.c, modal.c, reference.c and energy.c: whole impacts of toys,
 * by both methods, with their scales, starts and audits. */
#include "impact/impact_scale.h"
#include "impact/march.h"
#include "unit/impact/toy_scene.h"

static struct impact_outcome run(struct toy *toy, bool cvode, double accuracy, double horizon)
{
    struct impact_outcome outcome;
    struct impact_settings settings = {.accuracy = accuracy, .horizon = horizon, .max_work = 1e9};
    assert_true(impact_create(&outcome, &toy->scene, &toy->arena));
    enum percuss_status status =
        (cvode ? impact_cvode : impact_modal)(&toy->scene, &settings, &toy->arena, &outcome);
    assert_int_equal(status, PERCUSS_OK);
    return outcome;
}

/* A mass on a linear spring: half a period of contact, everything returned. */
static void a_mass_bounces_off_a_spring(void **state)
{
    (void)state;
    for (int cvode = 0; cvode < 2; cvode++) {
        struct toy toy;
        toy_init(&toy, 1);
        toy.laws[0] = contact_law_linear(100.0);
        toy.w[0] = 0.5;
        toy.gap_rate[0] = -2.0;
        struct impact_outcome outcome = run(&toy, cvode, 1e-9, 10.0);
        const struct sub_impact *sub = outcome.tracks[0].list;
        double omega = sqrt(50.0);
        assert_int_equal(outcome.tracks[0].count, 1);
        assert_int_equal(outcome.end_reason, PERCUSS_END_SEPARATED);
        /* accuracy 1e-9 of an impulse; the instants as good, the peak on a polynomial */
        measured("impulse", outcome.tracks[0].impulse, 8.0, 1e-8);
        measured("end", sub->end, M_PI / omega, 1e-7);
        measured("rate after", sub->gap_rate_after, 2.0, 1e-8);
        measured("indentation", sub->max_indentation, 2.0 / omega, 1e-6);
        measured("force", sub->peak_force, 200.0 / omega, 1e-4);
        measured("available", outcome.energy.available, 4.0, 1e-15);
        measured("closure", outcome.energy.closure, 0.0, 1e-7);
        toy_free(&toy);
    }
}

/* Bodies so far apart that their gap's last bit is work of the acceleration, here 2e-16 J of 1e-15
 * J: nothing is missing of their energy. */
static void rounding_of_a_wide_gap_is_no_loss(void **state)
{
    (void)state;
    struct toy toy;
    toy_init(&toy, 1);
    toy.w[0] = 1e4;
    toy.gap_rate[0] = -5e-6;
    toy.gap_acceleration[0] = 2.5e5;
    for (int i = 0; i < 20; i++) {
        toy.gap[0] = 0.029 * (1.0 + 0.01 * i);
        struct impact_outcome outcome = run(&toy, 0, 1e-9, 1e-12);
        assert_true(outcome.energy.closure == 0.0);
        /* m v^2/2 and the work of the acceleration, to the bits of the gap */
        near(outcome.energy.available, 1.25e-15, 2.5e-16);
    }
    toy_free(&toy);
}

/* A Hertz contact of a rigid pair, wherever its length lies between two levels of the ladder: its
 * impulse 2 v/w as the accuracy says (see docs/lab/accuracy.md), in few steps: its beginning and
 * its end take no more of them than its middle (counted are 12, 14, 18, 23). */
static void a_contact_takes_few_steps(void **state)
{
    (void)state;
    static const struct {
        double accuracy;
        unsigned long most;
    } cases[] = {{1e-3, 13}, {1e-4, 15}, {1e-5, 19}, {1e-6, 24}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int k = 0; k < 8; k++) {
            struct toy toy;
            toy_init(&toy, 1);
            toy.laws[0] = contact_law_hertz(1e8);
            toy.gap_rate[0] = -pow(32.0, k / 8.0); /* an eighth of an octave in duration, each */
            struct impact_outcome outcome = run(&toy, false, cases[i].accuracy, 1e3);
            double impulse = -2.0 * toy.gap_rate[0];
            measured("impulse", outcome.tracks[0].impulse, impulse,
                     0.1 * pow(cases[i].accuracy, 0.8) * impulse);
            assert_in_range(outcome.steps + outcome.rejected, 6, cases[i].most);
            toy_free(&toy);
        }
}

/* The same with a single blow's profile in fewer of them, which leave no more (counted are 7, 7,
 * 11, 15); and roughly, within a hundredth. */
static void a_single_blow_takes_fewer_steps(void **state)
{
    (void)state;
    static const struct {
        double accuracy;
        enum step_profile profile;
        unsigned long most;
        double left;
    } cases[] = {{1e-3, STEP_PROFILE_SINGLE, 9, 4e-4},
                 {1e-4, STEP_PROFILE_SINGLE, 10, 6.3e-5},
                 {1e-5, STEP_PROFILE_SINGLE, 14, 1e-5},
                 {1e-6, STEP_PROFILE_SINGLE, 19, 1.6e-6},
                 {1e-3, STEP_PROFILE_ROUGH, 9, 1e-2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int k = 0; k < 8; k++) {
            struct toy toy;
            struct impact_outcome outcome;
            struct impact_settings settings = {.accuracy = cases[i].accuracy,
                                               .horizon = 1e3,
                                               .max_work = 1e9,
                                               .profile = cases[i].profile};
            toy_init(&toy, 1);
            toy.laws[0] = contact_law_hertz(1e8);
            toy.gap_rate[0] = -pow(32.0, k / 8.0);
            assert_true(impact_create(&outcome, &toy.scene, &toy.arena));
            assert_int_equal(impact_modal(&toy.scene, &settings, &toy.arena, &outcome), PERCUSS_OK);
            double impulse = -2.0 * toy.gap_rate[0];
            measured("impulse", outcome.tracks[0].impulse, impulse, cases[i].left * impulse);
            assert_in_range(outcome.steps + outcome.rejected, 4, cases[i].most);
            toy_free(&toy);
        }
}

/* Contacts of a group that do not feel each other: each one's impulse is as exact as alone, and
 * that two others begin and end beside it takes few steps (counted are 19, 19, 22, 31; with a
 * sequence's profile 24, 33, 40, 51). */
static void a_group_takes_few_steps(void **state)
{
    (void)state;
    static const struct {
        double accuracy;
        unsigned long most;
    } cases[] = {{1e-3, 20}, {1e-4, 20}, {1e-5, 23}, {1e-6, 32}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int k = 0; k < 8; k++) {
            struct toy toy;
            toy_init(&toy, 3);
            for (int c = 0; c < 3; c++) {
                toy.laws[c] = contact_law_hertz(1e8);
                toy.gap_rate[c] = -pow(32.0, k / 8.0) * (1.0 + 2.0 * c);
            }
            struct impact_outcome outcome = run(&toy, false, cases[i].accuracy, 1e3);
            for (int c = 0; c < 3; c++) {
                double impulse = -2.0 * toy.gap_rate[c];
                measured("impulse", outcome.tracks[c].impulse, impulse,
                         0.1 * pow(cases[i].accuracy, 0.8) * impulse);
                assert_int_equal(outcome.tracks[c].count, 1);
            }
            assert_in_range(outcome.steps + outcome.rejected, 6, cases[i].most);
            toy_free(&toy);
        }
}

/* The closed form of a rigid pair against the integration, and e = 1 by both. */
static void the_closed_form_of_a_rigid_pair_agrees(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        struct toy toy;
        struct impact_outcome closed;
        struct impact_settings settings = {.accuracy = 1e-11, .horizon = 1e3, .max_work = 1e9};
        double v = pow(10.0, i - 5.0), w = pow(7.0, 3.0 - i);
        toy_init(&toy, 1);
        toy.laws[0] = i % 2 ? contact_law_linear(1e5) : contact_law_hertz(1e8);
        toy.gap_rate[0] = -v;
        toy.gap[0] = (i % 3 - 1) * 1e-4 * v;
        toy.w[0] = w;
        assert_true(impact_is_rigid_pair(&toy.scene));
        assert_true(impact_create(&closed, &toy.scene, &toy.arena));
        assert_int_equal(impact_rigid_pair(&toy.scene, &settings, &toy.arena, &closed), PERCUSS_OK);
        struct impact_outcome modal = run(&toy, false, 1e-11, 1e3);
        const struct sub_impact *a = closed.tracks[0].list, *b = modal.tracks[0].list;
        double impulse = 2.0 * v / w, lasts = a->end - a->start;
        measured("impulse", closed.tracks[0].impulse, impulse, 1e-15 * impulse);
        /* accuracy 1e-11, a thousand steps' rounding */
        measured("impulse, modal", modal.tracks[0].impulse, impulse, 1e-10 * impulse);
        measured("start", b->start, a->start, 1e-15 * (1.0 + fabs(a->start)));
        measured("end", b->end, a->end, 1e-8 * lasts);
        /* a flat top, on a polynomial */
        measured("compression end", b->compression_end, a->compression_end, 1e-4 * lasts);
        measured("indentation", b->max_indentation, a->max_indentation, 1e-7 * a->max_indentation);
        measured("force", b->peak_force, a->peak_force, 1e-6 * a->peak_force);
        /* the last step, of 4 accuracy^(3/10), ends after the contact */
        measured("window", modal.window, closed.window, 4e-3 * lasts);
        measured("available", modal.energy.available, closed.energy.available, 0.0);
        toy_free(&toy);
    }
}

/* One mode, one mass, damping, pressed, apart at first: both methods, sub-impact by sub-impact. */
static void both_methods_agree_on_toys(void **state)
{
    (void)state;
    static const double omega = 30.0, shape = 0.8;
    for (int i = 0; i < 8; i++) {
        struct impact_outcome outcomes[2];
        struct toy toy;
        toy_init(&toy, 1);
        toy.laws[0] = contact_law_hertz(2000.0);
        toy.residual[0] = 1e-5;
        toy.gap[0] = i & 1 ? 0.01 : 0.0;
        toy.gap_rate[0] = -0.5;
        toy.gap_acceleration[0] = i & 2 ? -0.3 : 0.0;
        struct scene_group *group = toy_add(&toy, 0, 1, &omega, i & 4 ? 0.04 : 0.0, &shape);
        toy_ring(&toy, group, &(double){0.001}, &(double){-0.03});
        for (int cvode = 0; cvode < 2; cvode++)
            outcomes[cvode] = run(&toy, cvode, 1e-9, 20.0);
        const struct track *a = outcomes[0].tracks, *b = outcomes[1].tracks;
        assert_int_equal(a->count, b->count);
        assert_int_equal(outcomes[0].end_reason, outcomes[1].end_reason);
        measured("impulse", a->impulse, b->impulse, 1e-6);
        measured("shift", outcomes[0].time_shift, outcomes[1].time_shift, 1e-9);
        for (size_t k = 0; k < a->count; k++) {
            measured("start", a->list[k].start, b->list[k].start, 1e-6);
            measured("sub-impulse", a->list[k].impulse, b->list[k].impulse, 1e-6);
        }
        for (int cvode = 0; cvode < 2; cvode++)
            measured("closure", outcomes[cvode].energy.closure / outcomes[cvode].energy.available,
                     0.0, 1e-7);
        toy_free(&toy);
    }
}

/* The scales of a rigid Hertz collision: stored = kinetic at the largest indentation. */
static void scales_follow_from_the_energy(void **state)
{
    (void)state;
    struct toy toy;
    toy_init(&toy, 1);
    toy.w[0] = 4.0; /* m = 1/4 */
    for (double k = 1.0; k < 1e12; k *= 1e3) {
        for (double v = 1e-6; v < 1e3; v *= 1e2) {
            toy.laws[0] = contact_law_hertz(k);
            struct impact_scale scale = impact_scale_of(&toy.scene, 0, -v);
            double depth = pow(1.25 * 0.25 * v * v / k, 0.4);
            measured("indentation", scale.indentation, depth, 1e-9 * depth);
            measured("duration", scale.duration, depth / v, 1e-9 * depth / v);
            measured("force", scale.force, k * pow(depth, 1.5), 1e-8 * k * pow(depth, 1.5));
        }
    }
    struct impact_scale rest = impact_scale_of(&toy.scene, 0, 0.0);
    assert_true(isfinite(rest.duration) && rest.indentation >= 0.0 && rest.duration > 0.0);
    toy_free(&toy);
}

static void overlaps_go_back_to_their_touch(void **state)
{
    (void)state;
    struct toy toy;
    struct motion motion;
    double shift = 9.0;
    toy_init(&toy, 2);
    toy.gap[0] = -0.1;
    toy.gap_rate[0] = -1.0;
    toy.gap[1] = -0.3; /* touched earlier: 0.15 s ago */
    toy.gap_rate[1] = -2.0;
    assert_true(motion_create(&motion, &toy.scene, &toy.arena));
    motion_start(&motion, &toy.scene);
    struct rewind rewind = {1.0, 1000, &toy.arena, NULL, false};
    assert_int_equal(rewind_to_touch(&rewind, &toy.scene, &motion, &shift), REWIND_TOUCHED);
    measured("shift", shift, -0.15, 1e-16);
    measured("gap", motion.gap[0], 0.05, 1e-16);
    measured("gap", motion.gap[1], 0.0, 1e-16);
    measured("time", motion.time, -0.15, 1e-16);
    toy.gap_rate[1] = 0.1; /* opens: it was never apart */
    motion_start(&motion, &toy.scene);
    assert_int_equal(rewind_to_touch(&rewind, &toy.scene, &motion, &shift), REWIND_NEVER);
    toy_free(&toy);
}

/* Where the second contact touched, 1 s before, the first one overlaps again: it is accelerated,
 * and was open only for the last half second. Begun there, its force would come from nothing. */
static void contacts_that_were_never_apart_are_refused(void **state)
{
    (void)state;
    struct toy toy;
    struct impact_outcome outcome;
    struct impact_settings settings = {.accuracy = 1e-6, .horizon = 10.0, .max_work = 1e6};
    for (int apart = 0; apart < 2; apart++) {
        toy_init(&toy, 2);
        /* d = 0.01 + t + t^2, which is negative from -0.99 to -0.01 s */
        toy.gap[0] = -0.01;
        toy.gap_rate[0] = -1.0;
        toy.gap_acceleration[0] = -2.0;
        toy.gap[1] = apart ? -0.05 : -0.1;
        toy.gap_rate[1] = -0.1;
        assert_true(impact_create(&outcome, &toy.scene, &toy.arena));
        assert_int_equal(impact_modal(&toy.scene, &settings, &toy.arena, &outcome), PERCUSS_OK);
        assert_int_equal(outcome.always_overlapped, !apart);
        if (apart)
            measured("energy", outcome.energy.closure, 0.0, 1e-4);
        toy_free(&toy);
    }
}

/* The work allowed bounds the effort and is said. */
static void effort_is_bounded(void **state)
{
    (void)state;
    static const double omega = 30.0, shape = 0.8;
    struct toy toy;
    struct impact_outcome outcome;
    struct impact_settings settings = {.accuracy = 1e-12, .horizon = 10.0, .max_work = 17.0 * 50.0};
    toy_init(&toy, 1);
    toy.gap_rate[0] = -1.0;
    toy.laws[0] = contact_law_hertz(1e4);
    toy_add(&toy, 0, 1, &omega, 0.0, &shape);
    assert_true(impact_create(&outcome, &toy.scene, &toy.arena));
    assert_int_equal(impact_modal(&toy.scene, &settings, &toy.arena, &outcome), PERCUSS_OK);
    assert_int_equal(outcome.end_reason, PERCUSS_END_LIMIT);
    assert_true(outcome.steps + outcome.rejected <= 51);
    assert_int_equal(impact_max_steps(&toy.scene, &settings), 50);
    toy_free(&toy);
}

static double between(uint64_t *seed, double low, double high)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) * 0x1p-53;
}

/* Two coupled contacts, whose steps may take many iterations, and a third one that a body rings
 * before without ever reaching it, for as long as anybody looks. */
static void ring_before_a_group(struct toy *toy, uint64_t *seed)
{
    static const double omega[] = {1.0, M_SQRT2}, shapes[] = {0.0, 0.0, 0.0, 0.0, 1.0, 1.0};
    static const double q[] = {0.6, 0.6}, v[] = {0.0, 0.0};
    toy_init(toy, 3);
    for (size_t c = 0; c < 2; c++) {
        toy->gap_rate[c] = -pow(10.0, between(seed, -1.0, 1.0));
        toy->laws[c] = contact_law_hertz(pow(10.0, between(seed, 2.0, 12.0)));
    }
    toy->gap[1] = between(seed, 0.0, 1e-3);
    toy->w[1] = toy->w[3] = between(seed, -0.9, 0.9);
    toy->gap[2] = 1.2 - 1e-9;
    toy_ring(toy, toy_add(toy, 1, 2, omega, 0.0, shapes), q, v);
}

/* Wherever the work allowed runs out: in a contact phase, with its last step, in a flight. */
static void no_flight_goes_on_when_the_work_is_spent(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int scene = 0; scene < 100; scene++) {
        struct toy toy;
        ring_before_a_group(&toy, &seed);
        double cost = step_cost(&toy.scene);
        for (unsigned long most = 1; most < 150; most++) {
            struct impact_outcome outcome;
            struct impact_settings settings = {
                .accuracy = 1e-3, .horizon = 1e4, .max_work = cost * ((double)most + 0.5)};
            assert_true(impact_create(&outcome, &toy.scene, &toy.arena));
            assert_int_equal(impact_modal(&toy.scene, &settings, &toy.arena, &outcome), PERCUSS_OK);
            /* a step that does not converge counts as several, when it is done */
            if (outcome.effort > most + 16)
                fail_msg("scene %d: %lu steps allowed, %lu taken", scene, most, outcome.effort);
        }
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mass_bounces_off_a_spring),
        cmocka_unit_test(rounding_of_a_wide_gap_is_no_loss),
        cmocka_unit_test(a_contact_takes_few_steps),
        cmocka_unit_test(a_single_blow_takes_fewer_steps),
        cmocka_unit_test(a_group_takes_few_steps),
        cmocka_unit_test(the_closed_form_of_a_rigid_pair_agrees),
        cmocka_unit_test(both_methods_agree_on_toys),
        cmocka_unit_test(scales_follow_from_the_energy),
        cmocka_unit_test(overlaps_go_back_to_their_touch),
        cmocka_unit_test(contacts_that_were_never_apart_are_refused),
        cmocka_unit_test(effort_is_bounded),
        cmocka_unit_test(no_flight_goes_on_when_the_work_is_spent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
