/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests solve/outcome.c: when a solution that was cut off says something of the restitution. */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_what_met_no_force_at_all_is_unsolved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
