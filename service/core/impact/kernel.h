/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The inner loops over the modes. Sums run in LANES fixed lanes, added in a fixed order at the end,
 * so that every vector unit gives the same bits. Arrays are 32-byte aligned, lengths multiples of
 * LANES. */
#ifndef PERCUSS_IMPACT_KERNEL_H
#define PERCUSS_IMPACT_KERNEL_H

#include <stdbool.h>

#include "impact/step_table.h"

/* sums[i] += sum_k phi_k (node_q[i]_k q_k + node_v[i]_k v_k): free displacement at the nodes, and
 * at the end of the step. */
void kernel_nodes(const struct step_table *table, size_t length, const double *phi, const double *q,
                  const double *v, double sums[STEP_POINTS]);

/* Free motion to the end of the step, into q_end and v_end. */
void kernel_advance(const struct step_table *table, size_t length, const double *q, const double *v,
                    double *q_end, double *v_end);

/* Adds the effect of the nodal forces through `phi` at the end of the step. */
void kernel_push(const struct step_table *table, size_t length, const double *phi,
                 const double force[NODES], double *q_end, double *v_end);

/* sum_k a_k x_k, and at once sum_k a_k y_k. */
void kernel_dot2(size_t length, const double *a, const double *x, const double *y, double *ax,
                 double *ay);

/* sums[i][j] += sum_k phi_a_k phi_b_k response[i][j]_k; the last row is of q at the end. */
void kernel_response(const struct step_table *table, size_t length, const double *phi_a,
                     const double *phi_b, double sums[STEP_POINTS][NODES]);

/* A contact's forces at the nodes, and how they reach the modes. */
struct kernel_load {
    const double *phi;   /* [length] */
    const double *force; /* [NODES] */
};

/* Energy lost to damping on the step: sum_k of the table's quadratic form of (q_k, v_k, f_1..f_4),
 * f_j the sum over the loads of phi_k force_j. Damped tables only. */
double kernel_loss(const struct step_table *table, size_t length, const double *const state[2],
                   const struct kernel_load *loads, size_t count);

/* From here on: undamped modes with the state at the middle of the step (enum middle_term). Turns a
 * state on, or back for way = -1. */
void kernel_turn(const double *middle, enum middle_term turn, double way, size_t length,
                 const double *const state[2], double *const to[2]);

/* Adds the effect of the nodal forces through `phi`. Before, the state is free motion from the
 * step's start; after, free motion leads from it to the end. */
void kernel_kick(const double *middle, size_t length, const double *phi, const double force[NODES],
                 double *const state[2]);

/* As kernel_nodes. */
void kernel_swing(const double *middle, size_t length, const double *phi,
                  const double *const state[2], double sums[STEP_POINTS]);

/* From one step to the next in one pass: kernel_kick and the turn by the tables of the one,
 * kernel_swing by those of the next. */
struct kernel_carry {
    const double *from, *next;
    enum middle_term turn;
    const double *force; /* [NODES] */
    bool nodes_only;     /* the sum at the end of the step stays as it is */
};
void kernel_carry(const struct kernel_carry *carry, size_t length, const double *phi,
                  double *const state[2], double sums[STEP_POINTS]);

#endif
