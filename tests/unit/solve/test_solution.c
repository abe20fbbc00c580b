/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/solution.c: tolerances that are met are, the same model gives the same
 * bits again, and the derivative is that of two solutions. */
#include "solve/solution.h"
#include "unit/solve/search_lab.h"

static struct solution solution;

static double found(struct search *search, const struct solve_request *request,
                    const struct solution_model *model)
{
    struct fault fault = {""};
    struct problem *problem = (struct problem *)search_begin(search, request)->problem;
    solution = (struct solution){0};
    if (solution_find(&solution, problem, problem->tolerance, model, &search->arena, NULL, &fault))
        fail_msg("%s", fault.text);
    return outcome_restitution(problem, &solution.outcome, 0);
}

static void tolerances_are_met(void **state)
{
    (void)state;
    static const double tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5};
    struct search *search = search_create();
    for (size_t i = 0; i < COUNT(tolerances); i++) {
        struct solve_request requests[] = {search_on_rod("rod", tolerances[i]),
                                           search_on_beam(tolerances[i])};
        for (size_t r = 0; r < COUNT(requests); r++) {
            double e = found(search, &requests[r], NULL);
            assert_true(solution.tolerance_met && !solution.spent);
            assert_true(solution.error.steps.restitution + solution.error.modes.restitution <=
                        tolerances[i]);
            struct attempt reference = search_attempt(search, 400, 1e-12);
            near(e, outcome_restitution(search->context.problem, &reference.outcome, 0),
                 tolerances[i]);
        }
    }
    search_free(search);
}

/* A model may take a mode more or less than the search did, but the same ones each time. */
static void its_model_solves_it_again(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request requests[] = {search_on_rod("rod", 1e-4), search_on_beam(1e-3)};
    for (size_t r = 0; r < COUNT(requests); r++) {
        double e = found(search, &requests[r], NULL);
        struct solution_model model = solution_model_of(&solution);
        double by_model = found(search, &requests[r], &model);
        near(by_model, e, requests[r].options.tolerance);
        near(found(search, &requests[r], &model), by_model, 0.0);
    }
    search_free(search);
}

static void the_derivative_is_that_of_two_solutions(void **state)
{
    (void)state;
    static const double step = 1e-3;
    struct search *search = search_create();
    struct solve_request request = search_on_rod("rod", 1e-6);
    request.options.conditioning = true;
    found(search, &request, NULL);
    double by_speed = solution.restitution_by_speed;
    struct solution_model model = solution_model_of(&solution);
    double e[2];
    for (int side = 0; side < 2; side++) {
        struct solve_request other = request;
        other.bodies[0].velocity[2] *= side ? 1.0 + step : 1.0 - step;
        e[side] = found(search, &other, &model);
    }
    /* the central difference leaves some 1e-6 of e''' */
    near_relative(by_speed, (e[1] - e[0]) / (2.0 * step * 0.3), 1e-4);
    search_free(search);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tolerances_are_met),
        cmocka_unit_test(its_model_solves_it_again),
        cmocka_unit_test(the_derivative_is_that_of_two_solutions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
