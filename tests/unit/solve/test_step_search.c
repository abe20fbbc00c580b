/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/solve/step_search.c: how far it goes, and that the error it
 * states is no less than the distance from a solution with far shorter steps. */
#include "solve/step_search.h"
#include "unit/solve/search_lab.h"

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
    nearby_begin(context->nearby, context->problem, &best.outcome);
    double allowed = context->work;
    assert_int_equal(step_search(context, &best, &(struct mode_error){0}, &error), PERCUSS_OK);
    double left = search_error(search, &best, &reference);
    assert_true(crude > 0.3 * request.options.tolerance);
    assert_true(best.accuracy <= 2e-3 / ATTEMPT_LONGER * 1.0001);
    assert_true(context->work < allowed);
    assert_true(error.energy_closes && !error.unchecked);
    assert_true(error.restitution <= SEQUENCE_STEPS_SHARE * request.options.tolerance);
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
    nearby_begin(context->nearby, context->problem, &best.outcome);
    assert_int_equal(
        step_search(context, &best, &(struct mode_error){.covers_steps = true}, &error),
        PERCUSS_OK);
    assert_true(context->work == allowed);
    assert_true(best.accuracy == 1e-7);
    /* without, a sequence is compared with one of longer steps */
    assert_int_equal(step_search(context, &best, &(struct mode_error){0}, &error), PERCUSS_OK);
    assert_true(context->work < allowed);
    assert_true(context->nearby->solutions > 1);
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
    nearby_begin(context->nearby, context->problem, &best.outcome);
    assert_int_equal(step_search(context, &best, &(struct mode_error){0}, &error), PERCUSS_OK);
    near(outcome_restitution(context->problem, &best.outcome, 0), 1.0, 1e-12);
    assert_true(error.energy_closes && error.restitution < 1e-3);
    search_free(search);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shortens_steps_until_they_do),
        cmocka_unit_test(believes_what_covers_it),
        cmocka_unit_test(a_rigid_pair_has_hardly_any_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
