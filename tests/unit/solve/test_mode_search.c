/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/solve/mode_search.c: which contacts are taken for sequences, and that the error
 * of the modes left out is no less than the distance from a solution with hundreds of them. */
#include "unit/solve/search_lab.h"

enum { ALL = 400 };
static const double ACCURACY = 1e-9;

static struct attempt searched(struct search *search, const struct solve_request *request,
                               struct mode_error *error)
{
    struct attempt best = {.accuracy = ACCURACY};
    assert_int_equal(mode_search(search_begin(search, request), &best, error), PERCUSS_OK);
    return best;
}

static void beams_and_groups_are_sequences(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request rod = search_on_rod("rod", 1e-3), beam = search_on_beam(1e-3);
    assert_false(mode_search_expects_sequence(search_begin(search, &rod)->problem));
    assert_true(mode_search_expects_sequence(search_begin(search, &beam)->problem));
    /* the same rod between two balls */
    struct solve_request group = rod;
    group.body_count = 3;
    group.contact_count = 2;
    group.bodies[2] = group.bodies[0];
    group.contacts[1] = group.contacts[0];
    group.contacts[1].a = 2;
    for (int k = 0; k < 3; k++) {
        group.contacts[1].normal[k] = -group.contacts[0].normal[k];
        group.contacts[1].point[k] = group.contacts[0].point[k] - group.contacts[0].normal[k];
        group.bodies[2].position[k] =
            group.contacts[1].point[k] + 0.015 * group.contacts[1].normal[k];
    }
    assert_true(mode_search_expects_sequence(search_begin(search, &group)->problem));
    search_free(search);
}

/* A rod once struck: a smaller tolerance takes more modes, each answer is as near as it says. */
static void more_modes_for_smaller_tolerances(void **state)
{
    (void)state;
    static const double tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5};
    struct search *search = search_create();
    size_t before = 0;
    for (size_t i = 0; i < COUNT(tolerances); i++) {
        struct solve_request request = search_on_rod("rod", tolerances[i]);
        struct mode_error error;
        struct attempt best = searched(search, &request, &error);
        struct attempt reference = search_attempt(search, ALL, ACCURACY);
        size_t modes = best.assembly->all_modes;
        assert_true(error.restitution <= SEQUENCE_MODES_SHARE * tolerances[i]);
        assert_true(search_error(search, &best, &reference) <= error.restitution);
        assert_true(modes > before && modes < ALL);
        before = modes;
    }
    search_free(search);
}

/* A beam that strikes twice: the errors are those of other solutions, which are remembered. */
static void a_sequence_is_compared_with_others(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-3);
    struct mode_error error;
    struct attempt best = searched(search, &request, &error);
    struct attempt reference = search_attempt(search, ALL, ACCURACY);
    assert_true(attempt_is_sequence(&best));
    assert_true(search->nearby.solutions > 1);
    assert_true(error.restitution <= request.options.tolerance);
    assert_true(search_error(search, &best, &reference) <= error.restitution);
    search_free(search);
}

/* Where the catalogue fixes the modes there is one attempt, and the error stays as it is. */
static void fixed_modes_are_kept(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request fixed = search_on_rod("three", 1e-6), free = search_on_rod("rod", 1e-6);
    struct mode_error error, small;
    struct attempt best = searched(search, &fixed, &error);
    assert_int_equal(best.assembly->all_modes, 3);
    assert_false(best.assembly->adjustable);
    assert_true(error.restitution > fixed.options.tolerance);
    searched(search, &free, &small);
    assert_true(small.restitution < error.restitution);
    search_free(search);
}

/* Rigid balls have none to leave out. */
static void a_rigid_pair_has_no_modes(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), sphere_spot("ball", 0.015), 0.3);
    struct mode_error error;
    struct attempt best = searched(search, &request, &error);
    assert_int_equal(best.assembly->all_modes, 0);
    near(error.restitution, 0.0, 0.0);
    near(outcome_restitution(search->context.problem, &best.outcome, 0), 1.0, 1e-12);
    search_free(search);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beams_and_groups_are_sequences),
        cmocka_unit_test(more_modes_for_smaller_tolerances),
        cmocka_unit_test(a_sequence_is_compared_with_others),
        cmocka_unit_test(fixed_modes_are_kept),
        cmocka_unit_test(a_rigid_pair_has_no_modes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
