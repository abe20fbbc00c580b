/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/solve/attempt.c: how careful a solution is, and what is solved again. */
#include "unit/solve/search_lab.h"

static const double ACCURACY = 1e-4;

/* An attempt at a request, its forces taken down, with a care; the work that it took. */
static double attempt_with(struct search *search, const struct solve_request *request,
                           enum impact_care care, struct attempt *attempt)
{
    struct attempt_context *context = search_begin(search, request);
    double work = context->work;
    *attempt = (struct attempt){
        .choice = {.cut = INFINITY, .most = 20}, .accuracy = ACCURACY, .care = care};
    assert_int_equal(attempt_assemble(context, attempt), PERCUSS_OK);
    assert_int_equal(attempt_run_logged(context, attempt, &attempt->assembly->scene), PERCUSS_OK);
    return work - context->work;
}

/* The beam swings back: what began as a single blow is the sequence to the bit, forces and all, and
 * both solutions count. */
static void a_single_blow_that_is_none_is_begun_again(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-3);
    struct attempt sequence;
    struct attempt single;
    double once = attempt_with(search, &request, IMPACT_CARE_SEQUENCE, &sequence);
    assert_true(sequence.outcome.tracks[0].count > 1);
    double impulse = sequence.outcome.tracks[0].impulse;
    unsigned long steps = sequence.outcome.steps;
    size_t logged = sequence.log->count;
    double both = attempt_with(search, &request, IMPACT_CARE_SINGLE, &single);
    assert_int_equal(single.care, IMPACT_CARE_SEQUENCE);
    assert_true(single.outcome.tracks[0].impulse == impulse);
    assert_int_equal(single.outcome.steps, steps);
    assert_int_equal(single.log->count, logged);
    assert_true(both > 1.3 * once);
    /* without a log too */
    struct attempt again = {.accuracy = ACCURACY, .care = IMPACT_CARE_SINGLE};
    again.assembly = single.assembly;
    assert_int_equal(attempt_run(&search->context, &again, &single.assembly->scene), PERCUSS_OK);
    assert_int_equal(again.care, IMPACT_CARE_SEQUENCE);
    assert_true(again.outcome.tracks[0].impulse == impulse);
    search_free(search);
}

/* One that is a single blow stays so: fewer steps, within what the accuracy leaves, and nobody asks
 * for its forces. */
static void a_single_blow_takes_fewer_steps(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_rod("rod", 1e-3);
    struct attempt sequence;
    struct attempt single;
    attempt_with(search, &request, IMPACT_CARE_SEQUENCE, &sequence);
    double impulse = sequence.outcome.tracks[0].impulse;
    unsigned long steps = sequence.outcome.steps;
    attempt_with(search, &request, IMPACT_CARE_SINGLE, &single);
    assert_int_equal(single.care, IMPACT_CARE_SINGLE);
    assert_null(single.log);
    assert_true(single.outcome.steps < 0.8 * steps);
    near(single.outcome.tracks[0].impulse, impulse, attempt_steps_leave(ACCURACY) * impulse);
    search_free(search);
}

/* A contact that acceleration presses as much as its approach does is no short blow: at 2 mm/s, but
 * not at 2 m/s. */
static void a_pressed_contact_takes_care(void **state)
{
    (void)state;
    struct search *search = search_create();
    static const double speeds[] = {2e-3, 2.0};
    for (size_t i = 0; i < COUNT(speeds); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), sphere_spot("ball", 0.015), speeds[i]);
        struct attempt attempt;
        request.contacts[0].gap_acceleration = -9.81;
        attempt_with(search, &request, IMPACT_CARE_SINGLE, &attempt);
        assert_int_equal(attempt.care, i ? IMPACT_CARE_SINGLE : IMPACT_CARE_SEQUENCE);
        assert_true(!attempt.log == (i == 1));
    }
    search_free(search);
}

/* A rough solution of the sequence has the same sub-impacts by half the steps. */
static void a_rough_solution_is_cheap(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-3);
    struct attempt sequence;
    struct attempt rough;
    attempt_with(search, &request, IMPACT_CARE_SEQUENCE, &sequence);
    double impulse = sequence.outcome.tracks[0].impulse;
    unsigned long steps = sequence.outcome.steps;
    size_t count = sequence.outcome.tracks[0].count;
    attempt_with(search, &request, IMPACT_CARE_ROUGH, &rough);
    assert_int_equal(rough.care, IMPACT_CARE_ROUGH);
    assert_int_equal(rough.outcome.tracks[0].count, count);
    assert_true(rough.outcome.steps < steps);
    near(rough.outcome.tracks[0].impulse, impulse, 1e-3 * impulse);
    search_free(search);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_single_blow_that_is_none_is_begun_again),
        cmocka_unit_test(a_single_blow_takes_fewer_steps),
        cmocka_unit_test(a_pressed_contact_takes_care),
        cmocka_unit_test(a_rough_solution_is_cheap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
