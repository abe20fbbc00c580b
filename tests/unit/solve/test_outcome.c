/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests solve/outcome.c: when a solution that was cut off says something of the restitution, and
 * how wrong that can be. */
#include "check.h"
#include "impact/oscillator.h"
#include "solve/outcome.h"

/* Two contacts that approach, and what a solution found of them. */
struct case_at_hand {
    double compression[2];
    struct problem problem;
    struct track tracks[2];
    struct impact_outcome outcome;
};

static void set(struct case_at_hand *at_hand, enum percuss_end_reason end, double second)
{
    *at_hand = (struct case_at_hand){.compression = {1.0, 2.0}};
    at_hand->problem.contact_count = 2;
    at_hand->problem.impulse_compression = at_hand->compression;
    at_hand->tracks[1].impulse = second;
    at_hand->outcome.tracks = at_hand->tracks;
    at_hand->outcome.end_reason = end;
}

static void only_what_met_no_force_at_all_is_unsolved(void **state)
{
    (void)state;
    struct case_at_hand at_hand;
    set(&at_hand, PERCUSS_END_LIMIT, 0.0);
    assert_true(outcome_is_unsolved(&at_hand.problem, &at_hand.outcome));
    /* one contact has, so that nothing was transmitted by the other so far */
    set(&at_hand, PERCUSS_END_LIMIT, 3.0);
    assert_false(outcome_is_unsolved(&at_hand.problem, &at_hand.outcome));
    assert_true(outcome_restitution(&at_hand.problem, &at_hand.outcome, 0) == -1.0);
    assert_true(outcome_restitution(&at_hand.problem, &at_hand.outcome, 1) == 0.5);
    /* solved to the end: they fly on */
    set(&at_hand, PERCUSS_END_SEPARATED, 0.0);
    assert_false(outcome_is_unsolved(&at_hand.problem, &at_hand.outcome));
}

static void a_restitution_is_wrong_by_no_more_than_it_can_be(void **state)
{
    (void)state;
    struct case_at_hand at_hand;
    struct contact_side sides[1][2] = {{{.body = 0}, {.body = 1}}};
    static struct solve_request request;
    set(&at_hand, PERCUSS_END_SEPARATED, 0.0);
    at_hand.problem.sides = sides;
    at_hand.problem.request = &request;
    const struct body_state *states[2] = {NULL, NULL};
    at_hand.problem.states = states;
    /* two contacts pass impulse on to each other: from -1 to 1 */
    assert_true(outcome_range(&at_hand.problem, &at_hand.outcome) == 2.0);
    /* one, e = .75 and .125: it may be 0, or 1 */
    at_hand.problem.contact_count = 1;
    at_hand.tracks[0].impulse = 1.75;
    assert_true(outcome_range(&at_hand.problem, &at_hand.outcome) == 0.75);
    at_hand.tracks[0].impulse = 1.125;
    assert_true(outcome_range(&at_hand.problem, &at_hand.outcome) == 0.875);
    /* cut off, pressed, or struck while it vibrates, it may be anything */
    at_hand.outcome.end_reason = PERCUSS_END_LIMIT;
    assert_true(outcome_range(&at_hand.problem, &at_hand.outcome) == 2.0);
    at_hand.outcome.end_reason = PERCUSS_END_HANDED_BACK;
    request.contacts[0].gap_acceleration = -1.0;
    assert_true(outcome_range(&at_hand.problem, &at_hand.outcome) == 2.0);
    request.contacts[0].gap_acceleration = 0.0;
    struct body_state ringing = {.dents = 0};
    at_hand.problem.states[1] = &ringing;
    assert_true(outcome_range(&at_hand.problem, &at_hand.outcome) == 2.0);
}

/* What acceleration takes leaves little available: the energy closes to a share of that, or to
 * rounding of the approach's. */
static void energy_closes_to_what_is_available(void **state)
{
    (void)state;
    double gap_rate = -2.0, compression = 1.0;
    struct problem problem = {
        .contact_count = 1, .gap_rate = &gap_rate, .impulse_compression = &compression};
    struct impact_outcome outcome = {.energy = {.available = 1.0, .closure = -0.009}};
    assert_true(outcome_energy_closes(&problem, &outcome, 0.01));
    assert_false(outcome_energy_closes(&problem, &outcome, 0.005));
    outcome.energy.available = 0.1;
    assert_false(outcome_energy_closes(&problem, &outcome, 0.01));
    assert_true(outcome_energy_defect(&problem, &outcome) < 0.01);
    outcome.energy = (struct impact_energy){.available = -1e-12, .closure = 5e-10};
    assert_true(outcome_energy_closes(&problem, &outcome, 1e-6));
    outcome.energy.closure = 5e-9;
    assert_false(outcome_energy_closes(&problem, &outcome, 1e-6));
}

/* Modes that the forces left with q = 3, 0 and v = 0, 2 at the beginning, as a solution says that
 * ended at a time: those of body 1. */
struct vibrating {
    struct scene_group group;
    struct impact_outcome outcome;
    double *q, *v;
};

static void vibrate(struct vibrating *vibrating, struct oscillators *set, double time,
                    struct arena *arena)
{
    static const double *participation[1] = {NULL};
    vibrating->q = arena_take(arena, 2 * set->stride, sizeof(double));
    vibrating->v = vibrating->q + set->stride;
    vibrating->q[0] = 3.0;
    vibrating->v[1] = 2.0;
    for (size_t k = 0; k < 2; k++)
        oscillator_advance(set->omega[k], set->damping[k], time, &vibrating->q[k],
                           &vibrating->v[k]);
    vibrating->group = (struct scene_group){
        .set = set, .count = 2, .stride = set->stride, .body = 1, .participation = participation};
    vibrating->outcome =
        (struct impact_outcome){.window = time,
                                .groups = 1,
                                .group = &vibrating->group,
                                .motion = {.q = &vibrating->q, .v = &vibrating->v}};
}

/* At whatever times the solutions end, by the modes of both, without what was stated otherwise. */
static void vibration_differs_by_what_forces_did(double damping)
{
    const double omega[2] = {2.0, 5.0};
    struct arena arena = {0};
    const struct problem problem = {.arena = &arena};
    struct oscillators *set = oscillators_create(2, omega, damping);
    struct vibrating one, other;
    double energy[2] = {0.0, 0.0};
    vibrate(&one, set, 0.7, &arena);
    vibrate(&other, set, 1.9, &arena);
    outcome_widen_vibration(&problem, &one.outcome, &other.outcome, energy);
    near(energy[1], 0.0, 1e-28);
    /* by 9 J in the slow mode, and by 1 m/s in the fast one */
    other.v[0] += 3.0 * M_SQRT2;
    other.v[1] += 1.0;
    outcome_widen_vibration(&problem, &one.outcome, &other.outcome, energy);
    near(energy[0], 0.0, 0.0);
    near(energy[1], 9.5, 1e-13);
    /* a solution with one mode less, and a larger difference that was there already */
    energy[1] = 0.0;
    other.group.count = 1;
    outcome_widen_vibration(&problem, &one.outcome, &other.outcome, energy);
    near(energy[1], 9.0, 1e-13);
    energy[1] = 10.0;
    outcome_widen_vibration(&problem, &other.outcome, &one.outcome, energy);
    near(energy[1], 10.0, 0.0);
    /* all of it stated otherwise, and moved on freely since */
    double *rest = arena_take(&arena, set->stride, sizeof *rest);
    double *q = arena_take(&arena, set->stride, sizeof *q);
    double *v = arena_take(&arena, set->stride, sizeof *v);
    v[0] = 3.0 * M_SQRT2;
    oscillator_advance(omega[0], damping, -1.9, &q[0], &v[0]);
    one.group.q = one.group.v = rest;
    other.group.q = q;
    other.group.v = v;
    energy[1] = 0.0;
    outcome_widen_vibration(&problem, &one.outcome, &other.outcome, energy);
    near(energy[1], 0.0, 1e-28);
    oscillators_free(set);
    arena_release(&arena);
}

static void undamped_vibration_differs(void **state)
{
    (void)state;
    vibration_differs_by_what_forces_did(0.0);
}

static void damped_vibration_differs(void **state)
{
    (void)state;
    vibration_differs_by_what_forces_did(0.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_what_met_no_force_at_all_is_unsolved),
        cmocka_unit_test(a_restitution_is_wrong_by_no_more_than_it_can_be),
        cmocka_unit_test(energy_closes_to_what_is_available),
        cmocka_unit_test(undamped_vibration_differs),
        cmocka_unit_test(damped_vibration_differs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
