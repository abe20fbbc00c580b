/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/coupling.c: which contacts feel each other, a block in closed form,
 * the sums of few and of many contacts against those of their blocks. */
#include "impact/coupling.h"
#include "unit/impact/toy_scene.h"

/* Steps of 1/32 s: the fastest mode turns by 1.9 rad. */
enum { MODES = 6, MORE_MODES = 3, LEVEL = 5 };
static const double omegas[] = {2.0, 5.0, 11.0, 23.0, 40.0, 60.0};

/* Numbers of both signs, around one. */
static double number(size_t i)
{
    return sin(1.0 + 2.7 * (double)i);
}

/* So many contacts: all share the first body's modes but the second contact; the second body's are
 * felt by the first half. W couples neighbours, the residual flexibility every second. */
static void make(struct toy *toy, size_t contacts, double damping)
{
    double shapes[TOY_CONTACTS * MODES];
    toy_init(toy, contacts);
    for (size_t a = 0; a < contacts; a++)
        for (size_t b = 0; b <= a; b++) {
            size_t apart = a - b;
            double residual = apart % 2 ? 0.0 : (a == b ? 0.03 : 0.002 * number(a * b));
            toy->residual[a * contacts + b] = toy->residual[b * contacts + a] = residual;
            toy->w[a * contacts + b] = toy->w[b * contacts + a] =
                apart > 1 ? 0.0 : (apart ? -0.4 : 1.0 + 0.1 * number(a));
        }
    for (size_t i = 0; i < contacts * MODES; i++)
        shapes[i] = number(i);
    struct scene_group *first = toy_add(toy, 0, MODES, omegas, damping, shapes);
    first->participation[1] = NULL;
    struct scene_group *second = toy_add(toy, 1, MORE_MODES, omegas + 1, damping, shapes + 5);
    for (size_t c = contacts / 2; c < contacts; c++)
        second->participation[c] = NULL;
}

static struct coupling prepared(struct toy *toy, int level)
{
    struct coupling coupling = {0};
    assert_true(coupling_create(&coupling, &toy->scene, &toy->arena));
    assert_int_equal(coupling_prepare(&coupling, &toy->scene, level, &toy->arena, NULL),
                     PERCUSS_OK);
    return coupling;
}

/* Every third contact bears nothing. */
static void sums_are_those_of_blocks(void **state)
{
    (void)state;
    static const size_t contacts[] = {1, 2, 5, 7, 8, 12};
    for (size_t i = 0; i < 2 * COUNT(contacts); i++) {
        size_t n = contacts[i / 2];
        double force[TOY_CONTACTS][NODES] = {{0}};
        double taken[TOY_CONTACTS][STEP_POINTS], end[TOY_CONTACTS][STEP_POINTS];
        struct toy toy;
        make(&toy, n, i % 2 ? 0.1 : 0.0);
        struct coupling coupling = prepared(&toy, LEVEL);
        for (size_t c = 0; c < n; c++)
            for (size_t j = 0; c % 3 != 1 && j < NODES; j++)
                force[c][j] = 1.0 + number(c * NODES + j);
        coupling_take(&coupling, &toy.scene, LEVEL, force, taken);
        coupling_take_end(&coupling, &toy.scene, LEVEL, force, end);
        for (size_t a = 0; a < n; a++) {
            double expected[STEP_POINTS] = {0.0}, scale = 0.0;
            for (size_t b = 0; b < n; b++) {
                double by[STEP_POINTS][NODES];
                coupling_between(&toy.scene, LEVEL, a, b, by);
                for (int p = 0; p < STEP_POINTS; p++)
                    for (int j = 0; j < NODES; j++) {
                        expected[p] += by[p][j] * force[b][j];
                        scale = fmax(scale, fabs(by[p][j] * force[b][j]));
                    }
            }
            /* sums of at most 48 terms in another order */
            for (int p = 0; p < STEP_POINTS; p++)
                near_scaled(taken[a][p], expected[p], scale, 48 * 2.3e-16);
            near_scaled(end[a][NODES], expected[NODES], scale, 48 * 2.3e-16);
        }
        toy_free(&toy);
    }
}

/* Without modes: h^2 w times the double integral of a cubic force, here of 1, s and s^3: s^2/2,
 * s^3/6 and s^5/20; and the residual flexibility at the nodes, not at the end. */
static void a_rigid_block(void **state)
{
    (void)state;
    struct toy toy;
    double h = step_length(LEVEL);
    toy_init(&toy, 2);
    memcpy(toy.w, (double[]){2.0, 0.7, 0.7, 3.0}, 4 * sizeof(double));
    memcpy(toy.residual, (double[]){0.5, 0.1, 0.1, 0.5}, 4 * sizeof(double));
    struct coupling coupling = prepared(&toy, LEVEL);
    for (int power = 0; power <= 3; power++) {
        double force[2][NODES] = {{0}}, taken[2][STEP_POINTS];
        for (int j = 0; j < NODES; j++)
            force[1][j] = pow(collocation.node[j], power);
        coupling_take(&coupling, &toy.scene, LEVEL, force, taken);
        for (int p = 0; p < STEP_POINTS; p++) {
            double s = p < NODES ? collocation.node[p] : 1.0;
            double travel = h * h * pow(s, power + 2) / ((power + 1.0) * (power + 2.0));
            double local = p < NODES ? pow(s, power) : 0.0;
            near(taken[0][p], 0.7 * travel + 0.1 * local, 1e-15);
            near(taken[1][p], 3.0 * travel + 0.5 * local, 1e-15);
        }
    }
    toy_free(&toy);
}

/* Pairs that share nothing are not looked at: their number grows with the contacts. */
static void only_what_is_shared(void **state)
{
    (void)state;
    static const size_t contacts[] = {6, 12};
    for (size_t i = 0; i < COUNT(contacts); i++) {
        size_t n = contacts[i];
        struct toy toy;
        toy_init(&toy, n);
        for (size_t a = 1; a < n; a += 2)
            toy.w[a * n + a - 1] = toy.w[(a - 1) * n + a] = 0.5;
        struct coupling coupling = prepared(&toy, LEVEL);
        assert_int_equal(coupling.first[n], 2 * n);
        assert_int_equal(coupling.blocks, coupling.by_modes ? n : 2 * n);
        toy_free(&toy);
    }
}

/* The blocks of a level are those between each two contacts; also where two bodies have the same
 * oscillators. */
static void blocks_are_those_of_pairs(void **state)
{
    (void)state;
    struct toy toy;
    double shapes[2][3 * MODES];
    toy_init(&toy, 3);
    for (size_t i = 0; i < 3 * MODES; i++) {
        shapes[0][i] = number(i);
        shapes[1][i] = number(i + 50);
    }
    struct scene_group *first = toy_add(&toy, 0, MODES, omegas, 0.0, shapes[0]);
    struct scene_group *second = toy_add(&toy, 1, MODES, omegas, 0.0, shapes[1]);
    struct oscillators *own = second->set;
    second->set = first->set;
    for (int level = LEVEL; level < LEVEL + 3; level++) {
        struct coupling coupling = prepared(&toy, level);
        for (size_t a = 0; a < 3; a++)
            for (size_t b = 0; b < 3; b++) {
                double by[STEP_POINTS][NODES];
                coupling_between(&toy.scene, level, a, b, by);
                const struct coupling_block *block = coupling_between_two(&coupling, level, a, b);
                assert_non_null(block);
                assert_memory_equal(block->by, by, sizeof by);
            }
    }
    second->set = own;
    toy_free(&toy);
}

/* Rounding may leave one of two elements of W that are zero. */
static void one_of_both_is_rounding(void **state)
{
    (void)state;
    for (size_t a = 0; a < 3; a++)
        for (size_t b = 0; b < 3; b++) {
            struct toy toy;
            double by[STEP_POINTS][NODES];
            if (a == b)
                continue;
            toy_init(&toy, 3);
            toy.w[3 * a + b] = 1e-17;
            struct coupling coupling = prepared(&toy, LEVEL);
            for (size_t c = 0; c < 3; c++) {
                coupling_between(&toy.scene, LEVEL, c, c, by);
                const struct coupling_block *own = coupling_own(&coupling, LEVEL, c);
                assert_memory_equal(own->by, by, sizeof by);
            }
            toy_free(&toy);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_those_of_blocks), cmocka_unit_test(a_rigid_block),
        cmocka_unit_test(only_what_is_shared),      cmocka_unit_test(blocks_are_those_of_pairs),
        cmocka_unit_test(one_of_both_is_rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
