/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/node_solver.c: what it solves fulfils the equations. */
#include "impact/node_solver.h"
#include "unit/impact/toy_scene.h"

enum { CONTACTS = 3, MODES = 2, LEVEL = 30 };

static const double omegas[MODES] = {0.6, 2.6};
static const double shapes[CONTACTS * MODES] = {1.5, 1.4, 1.2, -0.9, 0.7, -1.2};

/* The compliance in series is all that couples on so short a step. */
static void make(struct toy *toy, struct coupling *coupling, struct arena *arena, double residual)
{
    toy_init(toy, CONTACTS);
    for (size_t a = 0; a < CONTACTS; a++)
        for (size_t b = 0; b < CONTACTS; b++) {
            toy->w[a * CONTACTS + b] = a == b ? 1.0 : 0.2;
            toy->residual[a * CONTACTS + b] = a == b ? residual : 0.3 * residual;
        }
    toy_add(toy, 0, MODES, omegas, 0.0, shapes);
    assert_true(coupling_create(coupling, &toy->scene, arena));
    assert_int_equal(coupling_prepare(coupling, &toy->scene, LEVEL, arena, NULL), PERCUSS_OK);
}

static void the_solution_fulfils_the_equations(void **state)
{
    (void)state;
    struct toy toy;
    struct arena arena = {0};
    struct coupling coupling = {0};
    struct node_linear linear = {.count = 2, .contact = {0, 2}};
    double stiffness[CONTACTS][NODES] = {{0.5, 1.0, 1.5, 2.0}, {0}, {0.0, 0.1, 0.4, 0.9}};
    make(&toy, &coupling, &arena, 0.7);
    for (size_t r = 0; r < 2 * NODES; r++)
        for (size_t k = 0; k < NODE_LINEAR_RIGHT; k++)
            linear.row[r].right[k] = sin(1.0 + 3.0 * (double)r + 5.0 * (double)k);
    node_linear_fill(&linear, &coupling, LEVEL, stiffness);
    assert_true(node_linear_solve(&linear));
    for (size_t k = 0; k < NODE_LINEAR_RIGHT; k++) {
        double force[CONTACTS][NODES] = {{0}};
        double taken[CONTACTS][STEP_POINTS];
        for (size_t p = 0; p < 2; p++)
            for (size_t i = 0; i < NODES; i++)
                force[2 * p][i] = stiffness[2 * p][i] * linear.row[p * NODES + i].right[k];
        coupling_take(&coupling, &toy.scene, LEVEL, force, taken);
        for (size_t r = 0; r < 2 * NODES; r++) {
            size_t c = 2 * (r / NODES);
            double d = linear.row[r].right[k];
            near(d + taken[c][r % NODES], sin(1.0 + 3.0 * (double)r + 5.0 * (double)k), 1e-13);
        }
    }
    toy_free(&toy);
    arena_release(&arena);
}

/* A negative compliance as large as the law's own leaves nothing to divide by. */
static void what_has_no_solution_is_refused(void **state)
{
    (void)state;
    struct toy toy;
    struct arena arena = {0};
    struct coupling coupling = {0};
    struct node_linear linear = {.count = 1, .contact = {1}};
    double stiffness[CONTACTS][NODES] = {{0}, {1.0, 1.0, 1.0, 1.0}, {0}};
    make(&toy, &coupling, &arena, -1.0);
    node_linear_fill(&linear, &coupling, LEVEL, stiffness);
    assert_false(node_linear_solve(&linear));
    toy_free(&toy);
    arena_release(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_solution_fulfils_the_equations),
        cmocka_unit_test(what_has_no_solution_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
