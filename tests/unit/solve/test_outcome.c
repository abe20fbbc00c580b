/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests solve/outcome.c: when a solution that was cut off says something of the restitution, and
 * how wrong that can be. */
#include "check.h"
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_what_met_no_force_at_all_is_unsolved),
        cmocka_unit_test(a_restitution_is_wrong_by_no_more_than_it_can_be),
        cmocka_unit_test(energy_closes_to_what_is_available),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
