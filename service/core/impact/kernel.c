/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/kernel.h"

#include "impact/simd.h"

VECTOR_CLONES void kernel_nodes(const struct step_table *table, size_t length, const double *phi,
                                const double *q, const double *v, double sums[STEP_POINTS])
{
    lanes s0 = {0}, s1 = {0}, s2 = {0}, s3 = {0}, end = {0};
    for (size_t k = 0; k < length; k += LANES) {
        lanes pq = AT(phi, k) * AT(q, k);
        lanes pv = AT(phi, k) * AT(v, k);
        s0 += AT(table->node_q[0], k) * pq + AT(table->node_v[0], k) * pv;
        s1 += AT(table->node_q[1], k) * pq + AT(table->node_v[1], k) * pv;
        s2 += AT(table->node_q[2], k) * pq + AT(table->node_v[2], k) * pv;
        s3 += AT(table->node_q[3], k) * pq + AT(table->node_v[3], k) * pv;
        end += AT(table->end_qq, k) * pq + AT(table->end_qv, k) * pv;
    }
    sums[0] += TOTAL(s0);
    sums[1] += TOTAL(s1);
    sums[2] += TOTAL(s2);
    sums[3] += TOTAL(s3);
    sums[NODES] += TOTAL(end);
}

VECTOR_CLONES void kernel_advance(const struct step_table *table, size_t length, const double *q,
                                  const double *v, double *q_end, double *v_end)
{
    for (size_t k = 0; k < length; k += LANES) {
        lanes qk = AT(q, k);
        lanes vk = AT(v, k);
        *(lanes *)(q_end + k) = AT(table->end_qq, k) * qk + AT(table->end_qv, k) * vk;
        *(lanes *)(v_end + k) = AT(table->end_vq, k) * qk + AT(table->end_vv, k) * vk;
    }
}

VECTOR_CLONES void kernel_push(const struct step_table *table, size_t length, const double *phi,
                               const double force[NODES], double *q_end, double *v_end)
{
    for (size_t k = 0; k < length; k += LANES) {
        lanes p = AT(phi, k);
        lanes to_q = AT(table->force_q[0], k) * force[0] + AT(table->force_q[1], k) * force[1] +
                     AT(table->force_q[2], k) * force[2] + AT(table->force_q[3], k) * force[3];
        lanes to_v = AT(table->force_v[0], k) * force[0] + AT(table->force_v[1], k) * force[1] +
                     AT(table->force_v[2], k) * force[2] + AT(table->force_v[3], k) * force[3];
        *(lanes *)(q_end + k) += p * to_q;
        *(lanes *)(v_end + k) += p * to_v;
    }
}

/* Pairs of nodes: five points of a step with four nodes each keep ten sums in registers. */
#define HALF(array, k) (*(const half *)((array) + (k)))

VECTOR_CLONES void kernel_response(const struct step_table *table, size_t length,
                                   const double *phi_a, const double *phi_b,
                                   double sums[STEP_POINTS][NODES])
{
    const double *row = table->response;
    half low[STEP_POINTS] = {{0}};
    half high[STEP_POINTS] = {{0}};
    for (size_t k = 0; k < length; k++, row += RESPONSE_TERMS) {
        double p = phi_a[k] * phi_b[k];
#pragma GCC unroll 5
        for (int i = 0; i < STEP_POINTS; i++) {
            low[i] += p * HALF(row, i * NODES);
            high[i] += p * HALF(row, i * NODES + 2);
        }
    }
    for (int i = 0; i < STEP_POINTS; i++) {
        sums[i][0] += low[i][0];
        sums[i][1] += low[i][1];
        sums[i][2] += high[i][0];
        sums[i][3] += high[i][1];
    }
}

VECTOR_CLONES double kernel_loss(const struct step_table *table, size_t length,
                                 const double *const state[2], const struct kernel_load *loads,
                                 size_t count)
{
    lanes sum = {0};
    for (size_t k = 0; k < length; k += LANES) {
        lanes x[NODES + 2] = {AT(state[0], k), AT(state[1], k)};
        for (size_t b = 0; b < count; b++)
            for (int j = 0; j < NODES; j++)
                x[j + 2] += AT(loads[b].phi, k) * loads[b].force[j];
        for (int r = 0, term = 0; r < NODES + 2; r++) {
            lanes row = {0};
            for (int s = 0; s < r; s++, term++)
                row += AT(table->loss[term], k) * x[s];
            sum += (2.0 * row + AT(table->loss[term++], k) * x[r]) * x[r];
        }
    }
    return TOTAL(sum);
}

/* The forces of the pairs of nodes: their odd and even parts about the middle. */
struct pairs {
    double odd[2], even[2];
};

static inline struct pairs pair_up(const double force[NODES])
{
    return (struct pairs){{force[3] - force[0], force[2] - force[1]},
                          {force[0] + force[3], force[1] + force[2]}};
}

/* The nodes of the pairs from their cosines and sines, the outer pair's first. */
static inline void add_up(half cosine, half sine, double end, double sums[STEP_POINTS])
{
    half before = cosine - sine;
    half behind = cosine + sine;
    sums[0] += before[0];
    sums[1] += before[1];
    sums[2] += behind[1];
    sums[3] += behind[0];
    sums[NODES] += end;
}

/* Passes over undamped modes, for either width. */
#define SIMD_PASSES "impact/middle_passes.h"
#include "impact/simd_widths.h"

void kernel_dot2(size_t length, const double *a, const double *x, const double *y, double *ax,
                 double *ay)
{
    FOLD_EITHER(dot2)(length, a, x, y, ax, ay);
}

void kernel_turn(const double *middle, enum middle_term turn, double way, size_t length,
                 const double *const state[2], double *const to[2])
{
    FOLD_EITHER(turn)(middle, turn, way, length, state, to);
}

void kernel_kick(const double *middle, size_t length, const double *phi, const double force[NODES],
                 double *const state[2])
{
    FOLD_EITHER(kick)(middle, length, phi, force, state);
}

void kernel_swing(const double *middle, size_t length, const double *phi,
                  const double *const state[2], double sums[STEP_POINTS])
{
    FOLD_EITHER(swing)(middle, length, phi, state, sums);
}

void kernel_carry(const struct kernel_carry *carry, size_t length, const double *phi,
                  double *const state[2], double sums[STEP_POINTS])
{
    FOLD_EITHER(carry)(carry, length, phi, state, sums);
}
