/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/kernel.c: each loop against its sum written out, in any length of
 * lanes.
 */
#include <string.h>

#include "check.h"
#include "impact/kernel.h"

enum { LONGEST = 40 };

struct vectors {
    _Alignas(32) double phi[LONGEST], psi[LONGEST], q[LONGEST], v[LONGEST];
    _Alignas(32) double q_end[LONGEST], v_end[LONGEST];
    struct oscillators *set;
    const struct step_table *table;
    size_t stride;
};

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

static void make(struct vectors *x, size_t count)
{
    double omega[LONGEST];
    uint64_t seed = count;
    memset(x, 0, sizeof *x);
    for (size_t k = 0; k < count; k++) {
        omega[k] = 100.0 * (double)(k + 1) * (double)(k + 1);
        x->phi[k] = uniform(&seed);
        x->psi[k] = uniform(&seed);
        x->q[k] = uniform(&seed);
        x->v[k] = uniform(&seed);
    }
    x->set = oscillators_create(count, omega, 0.0);
    assert_non_null(x->set);
    x->table = oscillators_table(x->set, 13);
    assert_non_null(x->table);
    x->stride = x->set->stride;
}

/* sums of at most 40 terms of order one in another order */
#define agrees(value, expected) near(value, expected, 2e-14 * (1.0 + fabs(expected)))

static void nodes_and_dots(void **state)
{
    (void)state;
    for (size_t count = 1; count <= LONGEST; count += 3) {
        struct vectors x;
        double sums[STEP_POINTS] = {1.0, 2.0, 3.0, 4.0, 5.0};
        double a = 0.0, b = 0.0, pq = 0.0, pv = 0.0;
        make(&x, count);
        kernel_nodes(x.table, x.stride, x.phi, x.q, x.v, sums);
        for (int i = 0; i < STEP_POINTS; i++) {
            double expected = i + 1.0; /* adds to what is there */
            const double *by_q = i < NODES ? x.table->node_q[i] : x.table->end_qq;
            const double *by_v = i < NODES ? x.table->node_v[i] : x.table->end_qv;
            for (size_t k = 0; k < count; k++)
                expected += x.phi[k] * (by_q[k] * x.q[k] + by_v[k] * x.v[k]);
            agrees(sums[i], expected);
        }
        kernel_dot2(x.stride, x.phi, x.q, x.v, &a, &b);
        for (size_t k = 0; k < count; k++) {
            pq += x.phi[k] * x.q[k];
            pv += x.phi[k] * x.v[k];
        }
        agrees(a, pq);
        agrees(b, pv);
        oscillators_free(x.set);
    }
}

static void advance_and_push(void **state)
{
    (void)state;
    const double force[NODES] = {0.5, -1.0, 2.0, 0.25};
    for (size_t count = 1; count <= LONGEST; count += 3) {
        struct vectors x;
        make(&x, count);
        kernel_advance(x.table, x.stride, x.q, x.v, x.q_end, x.v_end);
        kernel_push(x.table, x.stride, x.phi, force, x.q_end, x.v_end);
        for (size_t k = 0; k < count; k++) {
            double q = x.table->end_qq[k] * x.q[k] + x.table->end_qv[k] * x.v[k];
            double v = x.table->end_vq[k] * x.q[k] + x.table->end_vv[k] * x.v[k];
            for (int j = 0; j < NODES; j++) {
                q += x.phi[k] * x.table->force_q[j][k] * force[j];
                v += x.phi[k] * x.table->force_v[j][k] * force[j];
            }
            agrees(x.q_end[k], q);
            agrees(x.v_end[k], v);
        }
        for (size_t k = count; k < x.stride; k++)
            assert_true(x.q_end[k] == 0.0 && x.v_end[k] == 0.0);
        /* in place */
        double kept[LONGEST];
        kernel_advance(x.table, x.stride, x.q, x.v, x.q_end, x.v_end);
        memcpy(kept, x.q_end, sizeof kept);
        kernel_advance(x.table, x.stride, x.q, x.v, x.q, x.v);
        assert_memory_equal(kept, x.q, x.stride * sizeof *kept);
        assert_memory_equal(x.v_end, x.v, x.stride * sizeof *kept);
        oscillators_free(x.set);
    }
}

static double response(const struct step_table *table, int i, int j, size_t k)
{
    return table->response[k * RESPONSE_TERMS + (size_t)(i * NODES + j)];
}

static void responses(void **state)
{
    (void)state;
    for (size_t count = 1; count <= LONGEST; count += 3) {
        struct vectors x;
        double sums[STEP_POINTS][NODES] = {{0.0}};
        make(&x, count);
        sums[1][2] = 7.0;
        kernel_response(x.table, x.stride, x.phi, x.psi, sums);
        for (int i = 0; i < STEP_POINTS; i++) {
            for (int j = 0; j < NODES; j++) {
                double expected = i == 1 && j == 2 ? 7.0 : 0.0;
                for (size_t k = 0; k < count; k++)
                    expected += x.phi[k] * x.psi[k] * response(x.table, i, j, k);
                agrees(sums[i][j], expected);
            }
        }
        oscillators_free(x.set);
    }
}

/* From the start of a step to its middle, kicked there, and on to its end: what kernel_advance and
 * kernel_push do; and from middle to middle at once, by any turn, what the parts do. */
static void steps_by_their_middle(void **state)
{
    (void)state;
    const double force[NODES] = {0.5, -1.0, 2.0, 0.25};
    for (size_t count = 1; count <= LONGEST; count += 3) {
        struct vectors x;
        _Alignas(32) double q[LONGEST] = {0.0}, v[LONGEST] = {0.0};
        double *const middle[2] = {q, v};
        const double *const start[2] = {x.q, x.v}, *const there[2] = {q, v};
        double sums[2][STEP_POINTS] = {{0.0}};
        make(&x, count);
        const double *terms = x.table->middle;
        kernel_advance(x.table, x.stride, x.q, x.v, x.q_end, x.v_end);
        kernel_push(x.table, x.stride, x.phi, force, x.q_end, x.v_end);
        kernel_nodes(x.table, x.stride, x.phi, x.q, x.v, sums[0]);
        kernel_turn(terms, TURN_HALF, 1.0, x.stride, start, middle);
        kernel_swing(terms, x.stride, x.phi, there, sums[1]);
        for (int i = 0; i < STEP_POINTS; i++)
            agrees(sums[1][i], sums[0][i]);
        kernel_kick(terms, x.stride, x.phi, force, middle);
        kernel_turn(terms, TURN_HALF, 1.0, x.stride, there, middle);
        for (size_t k = 0; k < x.stride; k++) {
            agrees(q[k], x.q_end[k]);
            /* q of order one, turned twice by rounded turns */
            near(v[k], x.v_end[k], 1e-15 * (1.0 + fabs(x.v_end[k]) + x.set->omega[k]));
        }
        /* back again, and to the middle of each next step */
        static const enum middle_term turns[] = {TURN_WHOLE, TURN_SHORTER, TURN_LONGER};
        for (int i = 0; i < 3; i++) {
            int level = i == 0 ? 13 : i == 1 ? 14 : 12;
            const double *next = oscillators_table(x.set, level)->middle;
            struct kernel_carry carry = {terms, next, turns[i], force, false};
            double carried[STEP_POINTS] = {0.0}, apart[STEP_POINTS] = {0.0};
            double nodes[STEP_POINTS] = {0.0};
            struct kernel_carry shorter = carry;
            shorter.nodes_only = true;
            kernel_turn(terms, TURN_HALF, 1.0, x.stride, start, middle);
            kernel_carry(&shorter, x.stride, x.phi, middle, nodes);
            kernel_turn(terms, TURN_HALF, 1.0, x.stride, start, middle);
            kernel_carry(&carry, x.stride, x.phi, middle, carried);
            assert_memory_equal(nodes, carried, NODES * sizeof *nodes);
            assert_true(nodes[NODES] == 0.0);
            kernel_nodes(oscillators_table(x.set, level), x.stride, x.phi, x.q_end, x.v_end, apart);
            for (int j = 0; j < STEP_POINTS; j++)
                agrees(carried[j], apart[j]);
            kernel_turn(next, TURN_HALF, -1.0, x.stride, there, middle);
            for (size_t k = 0; k < x.stride; k++)
                agrees(q[k], x.q_end[k]);
        }
        oscillators_free(x.set);
    }
}

/* Fixed lanes, fixed order: more padding at the end changes no bit. */
static void padding_changes_no_bit(void **state)
{
    (void)state;
    struct vectors x;
    double a[2], b[2];
    make(&x, 13);
    kernel_dot2(16, x.phi, x.q, x.v, &a[0], &b[0]);
    kernel_dot2(40, x.phi, x.q, x.v, &a[1], &b[1]);
    assert_memory_equal(&a[0], &a[1], sizeof *a);
    assert_memory_equal(&b[0], &b[1], sizeof *b);
    oscillators_free(x.set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_and_dots),
        cmocka_unit_test(advance_and_push),
        cmocka_unit_test(responses),
        cmocka_unit_test(steps_by_their_middle),
        cmocka_unit_test(padding_changes_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
