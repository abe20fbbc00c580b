/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/kernel.c: the vector unit chosen at start gives the bits of the
 * baseline.
 */
#include <string.h>

#include "check.h"

/* The source once more, under other names and for the baseline only. */
#define PERCUSS_ONE_KERNEL
#define kernel_nodes      baseline_nodes
#define kernel_advance    baseline_advance
#define kernel_push       baseline_push
#define kernel_dot2       baseline_dot2
#define kernel_response   baseline_response
#define kernel_loss       baseline_loss
#define kernel_turn       baseline_turn
#define kernel_kick       baseline_kick
#define kernel_swing      baseline_swing
#define kernel_carry(...) baseline_carry(__VA_ARGS__)
#include "impact/kernel.c"
#undef kernel_nodes
#undef kernel_advance
#undef kernel_push
#undef kernel_dot2
#undef kernel_response
#undef kernel_loss
#undef kernel_turn
#undef kernel_kick
#undef kernel_swing
#undef kernel_carry

void kernel_nodes(const struct step_table *table, size_t length, const double *phi, const double *q,
                  const double *v, double sums[STEP_POINTS]);
void kernel_advance(const struct step_table *table, size_t length, const double *q, const double *v,
                    double *q_end, double *v_end);
void kernel_push(const struct step_table *table, size_t length, const double *phi,
                 const double force[NODES], double *q_end, double *v_end);
void kernel_dot2(size_t length, const double *a, const double *x, const double *y, double *ax,
                 double *ay);
void kernel_response(const struct step_table *table, size_t length, const double *phi_a,
                     const double *phi_b, double sums[STEP_POINTS][NODES]);
double kernel_loss(const struct step_table *table, size_t length, const double *const state[2],
                   const struct kernel_load *loads, size_t count);
void kernel_turn(const double *middle, enum middle_term turn, double way, size_t length,
                 const double *const state[2], double *const to[2]);
void kernel_kick(const double *middle, size_t length, const double *phi, const double force[NODES],
                 double *const state[2]);
void kernel_swing(const double *middle, size_t length, const double *phi,
                  const double *const state[2], double sums[STEP_POINTS]);
void kernel_carry(const struct kernel_carry *carry, size_t length, const double *phi,
                  double *const state[2], double sums[STEP_POINTS]);

enum { LONGEST = 64 };

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

static void same(const double *a, const double *b, size_t count)
{
    assert_memory_equal(a, b, count * sizeof *a);
}

static void every_vector_unit_gives_the_same_bits(void **state)
{
    (void)state;
    static const double force[NODES] = {0.3, -1.7, 2.1, 0.9};
    uint64_t seed = 8;
    for (size_t count = 1; count <= LONGEST; count++) {
        _Alignas(32) double phi[LONGEST] = {0.0}, psi[LONGEST] = {0.0}, q[LONGEST] = {0.0};
        _Alignas(32) double v[LONGEST] = {0.0}, end[4][LONGEST];
        double omega[LONGEST], sums[2][STEP_POINTS] = {{0.0}}, dots[4],
                               response[2][STEP_POINTS][NODES] = {{{0}}};
        for (size_t k = 0; k < count; k++) {
            omega[k] = 50.0 * (double)(k + 1) * (double)(k + 1);
            phi[k] = uniform(&seed);
            psi[k] = uniform(&seed);
            q[k] = uniform(&seed);
            v[k] = uniform(&seed);
        }
        struct oscillators *set = oscillators_create(count, omega, 0.01);
        assert_non_null(set);
        const struct step_table *table = oscillators_table(set, 12);
        assert_non_null(table);
        size_t n = set->stride;
        kernel_nodes(table, n, phi, q, v, sums[0]);
        baseline_nodes(table, n, phi, q, v, sums[1]);
        same(sums[0], sums[1], STEP_POINTS);
        kernel_advance(table, n, q, v, end[0], end[1]);
        baseline_advance(table, n, q, v, end[2], end[3]);
        kernel_push(table, n, phi, force, end[0], end[1]);
        baseline_push(table, n, phi, force, end[2], end[3]);
        same(end[0], end[2], n);
        same(end[1], end[3], n);
        kernel_dot2(n, phi, q, v, &dots[0], &dots[1]);
        baseline_dot2(n, phi, q, v, &dots[2], &dots[3]);
        same(dots, dots + 2, 2);
        kernel_response(table, n, phi, psi, response[0]);
        baseline_response(table, n, phi, psi, response[1]);
        same(response[0][0], response[1][0], STEP_POINTS * NODES);
        const double *const q_and_v[2] = {q, v};
        const struct kernel_load loads[2] = {{phi, force}, {psi, force}};
        double losses[2] = {kernel_loss(table, n, q_and_v, loads, 2),
                            baseline_loss(table, n, q_and_v, loads, 2)};
        same(&losses[0], &losses[1], 1);
        oscillators_free(set);
    }
}

static void middles_too(void **state)
{
    (void)state;
    static const double force[NODES] = {0.3, -1.7, 2.1, 0.9};
    uint64_t seed = 9;
    for (size_t count = 1; count <= LONGEST; count++) {
        _Alignas(32) double phi[LONGEST] = {0.0}, states[2][2][LONGEST] = {{{0.0}}};
        double omega[LONGEST], sums[2][STEP_POINTS] = {{0.0}};
        for (size_t k = 0; k < count; k++) {
            omega[k] = 50.0 * (double)(k + 1) * (double)(k + 1);
            phi[k] = uniform(&seed);
            states[0][0][k] = states[1][0][k] = uniform(&seed);
            states[0][1][k] = states[1][1][k] = uniform(&seed);
        }
        struct oscillators *set = oscillators_create(count, omega, 0.0);
        assert_non_null(set);
        const double *middle = oscillators_table(set, 12)->middle;
        const struct kernel_carry carry = {middle, middle, TURN_WHOLE, force, false};
        double *const clone[2] = {states[0][0], states[0][1]};
        double *const base[2] = {states[1][0], states[1][1]};
        const double *const clones[2] = {clone[0], clone[1]}, *const bases[2] = {base[0], base[1]};
        size_t n = set->stride;
        kernel_turn(middle, TURN_HALF, -1.0, n, clones, clone);
        baseline_turn(middle, TURN_HALF, -1.0, n, bases, base);
        kernel_kick(middle, n, phi, force, clone);
        baseline_kick(middle, n, phi, force, base);
        kernel_swing(middle, n, phi, clones, sums[0]);
        baseline_swing(middle, n, phi, bases, sums[1]);
        kernel_carry(&carry, n, phi, clone, sums[0]);
        baseline_carry(&carry, n, phi, base, sums[1]);
        /* and without the ends, which stay as they are */
        struct kernel_carry nodes = carry;
        double ends = sums[0][NODES];
        nodes.nodes_only = true;
        kernel_carry(&nodes, n, phi, clone, sums[0]);
        baseline_carry(&nodes, n, phi, base, sums[1]);
        assert_true(sums[0][NODES] == ends);
        same(states[0][0], states[1][0], 2 * LONGEST);
        same(sums[0], sums[1], STEP_POINTS);
        oscillators_free(set);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_vector_unit_gives_the_same_bits),
        cmocka_unit_test(middles_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
