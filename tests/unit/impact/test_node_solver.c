/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/node_solver.c and node_factors.h: contacts one by one and all at once
 * find the same, which solves the equations; where contacts matter much to each other the first
 * gives up. */
#include "impact/node_factors.h"
#include "impact/node_solver.h"
#include "unit/impact/toy_scene.h"

enum { LEVEL = 3 };

struct solution {
    double d[TOY_CONTACTS][NODES], force[TOY_CONTACTS][NODES], stiffness[TOY_CONTACTS][NODES];
};

struct made {
    struct toy toy;
    struct coupling coupling;
    double target[TOY_CONTACTS][STEP_POINTS], taken[TOY_CONTACTS][STEP_POINTS];
    double matrix[TOY_CONTACTS * NODES * TOY_CONTACTS * NODES];
};

/* Contacts in a row, with modes that all of them feel; every fourth stays open, every third closes
 * within the step. `between`: residual flexibility of neighbours. */
static struct node_problem make(struct made *made, size_t contacts, double between)
{
    static const double omegas[] = {3.0, 8.0, 20.0};
    double shapes[3 * TOY_CONTACTS];
    struct toy *toy = &made->toy;
    toy_init(toy, contacts);
    made->coupling = (struct coupling){0};
    for (size_t c = 0; c < contacts; c++) {
        toy->laws[c] = contact_law_hertz(3.0 + (double)c);
        toy->residual[c * (contacts + 1)] = 0.02;
        if (c > 0) {
            toy->w[c * contacts + c - 1] = toy->w[(c - 1) * contacts + c] = -0.4;
            toy->residual[c * contacts + c - 1] = toy->residual[(c - 1) * contacts + c] = between;
        }
        for (size_t k = 0; k < 3; k++)
            shapes[c * 3 + k] = 0.3 * sin(1.0 + 2.7 * (double)(c * 3 + k));
        for (int i = 0; i < NODES; i++) {
            double s = collocation.node[i];
            made->target[c][i] = c % 4 == 3 ? -0.5 : c % 3 == 2 ? 0.2 * (s - 0.4) : 0.3 + 0.2 * s;
        }
    }
    toy_add(toy, 0, 3, omegas, 0.0, shapes);
    assert_true(coupling_create(&made->coupling, &toy->scene, &toy->arena));
    assert_int_equal(coupling_prepare(&made->coupling, &toy->scene, LEVEL, &toy->arena, NULL),
                     PERCUSS_OK);
    return (struct node_problem){
        .scene = &toy->scene,
        .coupling = &made->coupling,
        .level = LEVEL,
        .target = (const double(*)[STEP_POINTS])made->target,
        .taken = made->taken,
        .last_change = node_solver_last_change(0.0),
    };
}

/* From the approaches without force. */
static bool solve(struct made *made, const struct node_problem *problem, bool together,
                  struct solution *solution)
{
    unsigned long iterations = 0;
    for (size_t c = 0; c < problem->scene->contacts; c++)
        memcpy(solution->d[c], made->target[c], sizeof solution->d[c]);
    return together ? node_solve_together(problem, made->matrix, solution->d, solution->force,
                                          solution->stiffness, &iterations)
                    : node_solve(problem, solution->d, solution->force, solution->stiffness,
                                 &iterations);
}

/* d + coupling F = target with F = law(d); 1e-13: roundings of sums of up to 48 terms of 0.1. */
static void expect_solved(struct made *made, const struct node_problem *problem,
                          const struct solution *solution)
{
    coupling_take(&made->coupling, problem->scene, LEVEL, (double(*)[NODES])solution->force,
                  made->taken);
    for (size_t c = 0; c < problem->scene->contacts; c++)
        for (int i = 0; i < NODES; i++) {
            double slope;
            near(solution->d[c][i] + made->taken[c][i], made->target[c][i], 1e-13);
            near(solution->force[c][i],
                 contact_law_force(&problem->scene->laws[c], solution->d[c][i], &slope), 1e-13);
        }
}

static void both_ways_agree(void **state)
{
    (void)state;
    for (size_t n = 1; n <= TOY_CONTACTS; n++) {
        struct made made;
        struct solution apart, together;
        struct node_problem problem = make(&made, n, 0.002);
        assert_true(solve(&made, &problem, false, &apart));
        assert_true(solve(&made, &problem, true, &together));
        expect_solved(&made, &problem, &apart);
        expect_solved(&made, &problem, &together);
        for (size_t c = 0; c < n; c++)
            for (int i = 0; i < NODES; i++)
                near(apart.force[c][i], together.force[c][i], 1e-12);
        toy_free(&made.toy);
    }
}

/* Neighbours that give way more under each other's force than under their own. */
static void close_neighbours_need_both(void **state)
{
    (void)state;
    struct made made;
    struct solution solution;
    struct node_problem problem = make(&made, 3, 0.8);
    assert_false(solve(&made, &problem, false, &solution));
    assert_true(solve(&made, &problem, true, &solution));
    expect_solved(&made, &problem, &solution);
    toy_free(&made.toy);
}

/* With a coarse accuracy the iteration ends early, but no earlier than that allows. */
static void an_accuracy_is_kept(void **state)
{
    (void)state;
    static const double accuracies[] = {1e-2, 1e-3, 1e-4, 1e-6, 1e-9};
    struct made made;
    struct solution exact, coarse;
    struct node_problem problem = make(&made, 9, 0.01);
    assert_true(solve(&made, &problem, true, &exact));
    for (size_t i = 0; i < COUNT(accuracies); i++) {
        double largest = 0.0;
        problem.last_change = node_solver_last_change(accuracies[i]);
        assert_true(solve(&made, &problem, false, &coarse));
        for (size_t c = 0; c < 9; c++)
            for (int j = 0; j < NODES; j++)
                largest = fmax(largest, exact.force[c][j]);
        for (size_t c = 0; c < 9; c++)
            for (int j = 0; j < NODES; j++)
                near(coarse.force[c][j], exact.force[c][j], accuracies[i] * largest);
    }
    toy_free(&made.toy);
}

/* (1 + m K) x = b, and no answer where a pivot vanishes. */
static void linear_equations_are_solved(void **state)
{
    (void)state;
    static const double stiffness[NODES] = {0.5, 2.0, 0.0, 1.0};
    static const double expected[NODES] = {1.0, -2.0, 3.0, 0.5};
    double m[NODES][NODES];
    double b[NODES];
    double x[NODES];
    for (int i = 0; i < NODES; i++) {
        b[i] = expected[i];
        for (int j = 0; j < NODES; j++) {
            m[i][j] = 0.3 * sin(1.0 + 1.7 * (i * NODES + j));
            b[i] += m[i][j] * stiffness[j] * expected[j];
        }
    }
    assert_true(node_solve_linear((const double(*)[NODES])m, stiffness, b, x));
    for (int i = 0; i < NODES; i++)
        near(x[i], expected[i], 1e-14);
    /* by its factors, for two right sides */
    struct node_row rows[NODES];
    double twice[NODES];
    node_rows_make((const double(*)[NODES])m, stiffness, rows);
    struct node_factors factors = node_factors_make(rows);
    assert_true(factors.sound);
    for (int factor = 1; factor <= 2; factor++) {
        for (int i = 0; i < NODES; i++)
            b[i] *= factor;
        node_factors_solve(&factors, b, twice);
        for (int i = 0; i < NODES; i++)
            near(twice[i], factor * x[i], 0.0);
    }
    m[0][0] = -1.0 / stiffness[0];
    assert_false(node_solve_linear((const double(*)[NODES])m, stiffness, b, x));
    node_rows_make((const double(*)[NODES])m, stiffness, rows);
    factors = node_factors_make(rows);
    assert_false(factors.sound);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_ways_agree),
        cmocka_unit_test(close_neighbours_need_both),
        cmocka_unit_test(an_accuracy_is_kept),
        cmocka_unit_test(linear_equations_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
