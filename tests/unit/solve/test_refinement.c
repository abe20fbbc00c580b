/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/error/refinement.c: which contacts are taken for sequences, and that
 * the errors of modes, of steps and of a sequence of sub-impacts are no less than the distance from
 * a solution with hundreds of modes or far shorter steps. */
#include "solve/error/attempt.h"
#include "solve/error/calibration.h"
#include "solve/error/refinement.h"
#include "unit/solve/search_lab.h"

enum { ALL = 400 };
static const double ACCURACY = 1e-9;

static struct attempt searched(struct search *search, const struct solve_request *request,
                               struct mode_error *error)
{
    struct attempt best = {.accuracy = ACCURACY};
    assert_int_equal(refine_modes(search_begin(search, request), &best, error), PERCUSS_OK);
    return best;
}

static void beams_and_groups_are_sequences(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request rod = search_on_rod("rod", 1e-3), beam = search_on_beam(1e-3);
    assert_false(refinement_expects_sequence(search_begin(search, &rod)->problem));
    assert_true(refinement_expects_sequence(search_begin(search, &beam)->problem));
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
    assert_true(refinement_expects_sequence(search_begin(search, &group)->problem));
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
        assert_true(error.restitution <= SHARE_MODES * tolerances[i]);
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
    assert_true(search->neighbours.solutions > 1);
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

/* A sequence with these modes and steps, and what is asked of it. */
static struct mode_error compared(struct search *search, size_t modes, double accuracy,
                                  double known, struct attempt *best)
{
    struct attempt_context *context = &search->context;
    struct mode_error error = {.restitution = known};
    *best = search_attempt(search, modes, accuracy);
    assert_true(attempt_is_sequence(best));
    neighbours_begin(context->neighbours, context->problem, &best->outcome);
    assert_int_equal(refinement_compare(context, best, &error), PERCUSS_OK);
    return error;
}

/* It is never less than what was known before, nor than the distance from far more modes; and the
 * comparisons stay in the range of spread solutions, with the answer in it. */
static void widens_what_is_known(void **state)
{
    (void)state;
    /* of 12 to 16 neighbours do not see that another branch of the sequence is right */
    static const size_t modes[] = {20, 28, 40, 80};
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-3);
    search_begin(search, &request);
    struct attempt reference = search_attempt(search, 400, 1e-11);
    for (size_t i = 0; i < COUNT(modes); i++) {
        struct attempt best;
        struct mode_error error = compared(search, modes[i], 1e-8, 1e-5, &best);
        const struct neighbours *neighbours = search->context.neighbours;
        double e = outcome_restitution(search->context.problem, &best.outcome, 0);
        assert_true(error.restitution >= 1e-5);
        assert_true(error.restitution >= search_error(search, &best, &reference));
        assert_true(neighbours->solutions > 1 && neighbours->low[0] <= e &&
                    e <= neighbours->high[0]);
        assert_int_not_equal(error.verdict, MODES_UNCHECKED);
    }
    search_free(search);
}

/* A loose tolerance needs no solution beside the answer where first order says enough; a tight one
 * has one. */
static void first_order_stands_for_solutions(void **state)
{
    (void)state;
    static const struct {
        double tolerance;
        bool followed;
    } cases[] = {{1e-2, true}, {1e-3, true}, {1e-4, true}, {6e-5, false}};
    struct search *search = search_create();
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
        request.options.tolerance = cases[i].tolerance;
        struct attempt_context *context = search_begin(search, &request);
        struct attempt reference = search_attempt(search, 400, 1e-11);
        struct attempt best = {.accuracy = attempt_first_accuracy(cases[i].tolerance, true, false)};
        struct mode_error error;
        assert_int_equal(refine_modes(context, &best, &error), PERCUSS_OK);
        assert_int_equal(error.verdict, MODES_AND_STEPS);
        assert_int_equal(context->neighbours->solutions == 1, cases[i].followed);
        assert_true(search_error(search, &best, &reference) <= error.restitution);
        assert_true(error.restitution <= cases[i].tolerance);
        assert_true(error.strained > 0.1);
    }
    search_free(search);
}

/* Steps so long that they matter more than the modes are told apart, and named. */
static void tells_steps_from_modes(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-6);
    struct attempt best;
    search_begin(search, &request);
    struct mode_error error = compared(search, 200, 1e-3, 0.0, &best);
    assert_int_equal(error.verdict, MODES_BELOW_STEPS);
    assert_non_null(error.longer);
    near_relative(error.longer->accuracy, 1e-3 * LONGER_STEPS, 1e-12);
    error = compared(search, 12, 1e-11, 0.0, &best);
    assert_int_not_equal(error.verdict, MODES_BELOW_STEPS);
    assert_true(error.restitution > request.options.tolerance);
    search_free(search);
}

/* Where the effort left does not suffice for another solution nothing is known. */
static void without_effort_it_stays_unchecked(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-3);
    struct attempt_context *context = search_begin(search, &request);
    struct attempt best = search_attempt(search, 20, 1e-8);
    struct mode_error error = {0};
    neighbours_begin(context->neighbours, context->problem, &best.outcome);
    context->work = 1000.0;
    assert_int_equal(refinement_compare(context, &best, &error), PERCUSS_OK);
    assert_int_equal(error.verdict, MODES_UNCHECKED);
    assert_int_equal(context->neighbours->solutions, 1);
    search_free(search);
}

enum { MODES = 12 };
static const double FINE = 1e-13;

/* From steps that are too long to those that meet the tolerance: by hundreds. */
static void shortens_steps_until_they_do(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_rod("rod", 2e-6);
    struct attempt_context *context = search_begin(search, &request);
    struct attempt reference = search_attempt(search, MODES, FINE);
    struct attempt best = search_attempt(search, MODES, 2e-3);
    double crude = search_error(search, &best, &reference);
    struct step_error error;
    neighbours_begin(context->neighbours, context->problem, &best.outcome);
    double allowed = context->work;
    assert_int_equal(refine_steps(context, &best, &(struct mode_error){0}, &error), PERCUSS_OK);
    double left = search_error(search, &best, &reference);
    assert_true(crude > 0.3 * request.options.tolerance);
    assert_true(best.accuracy <= 2e-3 / LONGER_STEPS * 1.0001);
    assert_true(context->work < allowed);
    assert_true(error.energy_closes && !error.unchecked);
    assert_true(error.restitution <= SHARE_STEPS * request.options.tolerance);
    assert_true(left <= error.restitution);
    search_free(search);
}

/* What the modes' comparison has covered is not solved again. */
static void believes_what_covers_it(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-3);
    struct attempt_context *context = search_begin(search, &request);
    struct attempt best = search_attempt(search, MODES, 1e-7);
    assert_true(attempt_is_sequence(&best));
    struct step_error error;
    double allowed = context->work;
    neighbours_begin(context->neighbours, context->problem, &best.outcome);
    assert_int_equal(
        refine_steps(context, &best, &(struct mode_error){.verdict = MODES_AND_STEPS}, &error),
        PERCUSS_OK);
    assert_true(context->work == allowed);
    assert_true(best.accuracy == 1e-7);
    /* without, a sequence is compared with one of longer steps */
    assert_int_equal(refine_steps(context, &best, &(struct mode_error){0}, &error), PERCUSS_OK);
    assert_true(context->work < allowed);
    assert_true(context->neighbours->solutions > 1);
    search_free(search);
}

/* Two rigid balls rebound as they came: e = 1. */
static void a_rigid_pair_has_hardly_any_error(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), sphere_spot("ball", 0.015), 0.3);
    struct attempt_context *context = search_begin(search, &request);
    struct attempt best = search_attempt(search, MODES, 1e-6);
    struct step_error error;
    neighbours_begin(context->neighbours, context->problem, &best.outcome);
    assert_int_equal(refine_steps(context, &best, &(struct mode_error){0}, &error), PERCUSS_OK);
    near(outcome_restitution(context->problem, &best.outcome, 0), 1.0, 1e-12);
    assert_true(error.energy_closes && error.restitution < 1e-3);
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
        cmocka_unit_test(widens_what_is_known),
        cmocka_unit_test(first_order_stands_for_solutions),
        cmocka_unit_test(tells_steps_from_modes),
        cmocka_unit_test(without_effort_it_stays_unchecked),
        cmocka_unit_test(shortens_steps_until_they_do),
        cmocka_unit_test(believes_what_covers_it),
        cmocka_unit_test(a_rigid_pair_has_hardly_any_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
