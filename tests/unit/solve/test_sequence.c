/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/solve/sequence.c: what solutions beside a sequence of sub-impacts add to its
 * error. */
#include "solve/first_steps.h"
#include "unit/solve/search_lab.h"

/* A sequence with these modes and steps, and what is asked of it. */
static struct mode_error compared(struct search *search, size_t modes, double accuracy,
                                  double known, struct attempt *best)
{
    struct attempt_context *context = &search->context;
    struct mode_error error = {.restitution = known};
    *best = search_attempt(search, modes, accuracy);
    assert_true(attempt_is_sequence(best));
    nearby_begin(context->nearby, context->problem, &best->outcome);
    assert_int_equal(sequence_compare(context, best, &error), PERCUSS_OK);
    return error;
}

/* It is never less than what was known before, nor than the distance from far more modes; and the
 * comparisons stay in the range of nearby solutions, with the answer in it. */
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
        const struct nearby *nearby = search->context.nearby;
        double e = outcome_restitution(search->context.problem, &best.outcome, 0);
        assert_true(error.restitution >= 1e-5);
        assert_true(error.restitution >= search_error(search, &best, &reference));
        assert_true(nearby->solutions > 1 && nearby->low[0] <= e && e <= nearby->high[0]);
        assert_false(error.unchecked);
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
    } cases[] = {{1e-2, true}, {1e-3, true}, {1e-4, true}, {9e-5, false}};
    struct search *search = search_create();
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
        request.options.tolerance = cases[i].tolerance;
        struct attempt_context *context = search_begin(search, &request);
        struct attempt reference = search_attempt(search, 400, 1e-11);
        struct attempt best = {.accuracy = first_steps_accuracy(cases[i].tolerance, true, false)};
        struct mode_error error;
        assert_int_equal(mode_search(context, &best, &error), PERCUSS_OK);
        assert_true(error.covers_steps);
        assert_int_equal(context->nearby->solutions == 1, cases[i].followed);
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
    assert_true(error.by_steps && !error.covers_steps);
    assert_non_null(error.longer);
    near_relative(error.longer->accuracy, 1e-3 * ATTEMPT_LONGER, 1e-12);
    error = compared(search, 12, 1e-11, 0.0, &best);
    assert_false(error.by_steps);
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
    nearby_begin(context->nearby, context->problem, &best.outcome);
    context->work = 1000.0;
    assert_int_equal(sequence_compare(context, &best, &error), PERCUSS_OK);
    assert_true(error.unchecked && !error.covers_steps);
    assert_int_equal(context->nearby->solutions, 1);
    search_free(search);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(widens_what_is_known),
        cmocka_unit_test(first_order_stands_for_solutions),
        cmocka_unit_test(tells_steps_from_modes),
        cmocka_unit_test(without_effort_it_stays_unchecked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
