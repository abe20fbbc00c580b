/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The inner loops over the modes. Sums run in LANES fixed lanes, added in a fixed order at the end,
 * so that every vector unit gives the same bits. Arrays are 32-byte aligned, lengths multiples of
 * LANES. */
#ifndef PERCUSS_IMPACT_KERNEL_H
#define PERCUSS_IMPACT_KERNEL_H

#include "impact/step_table.h"

/* sums[i] += sum_k phi_k (node_q[i]_k q_k + node_v[i]_k v_k): free displacement at the nodes. */
void kernel_nodes(const struct step_table *table, size_t length, const double *phi, const double *q,
                  const double *v, double sums[NODES]);

/* Free motion to the end of the step, into q_end and v_end. */
void kernel_advance(const struct step_table *table, size_t length, const double *q, const double *v,
                    double *q_end, double *v_end);

/* Adds what the forces at the nodes through `phi` do until the end of the step. */
void kernel_push(const struct step_table *table, size_t length, const double *phi,
                 const double force[NODES], double *q_end, double *v_end);

/* sum_k a_k x_k, and at once sum_k a_k y_k. */
void kernel_dot2(size_t length, const double *a, const double *x, const double *y, double *ax,
                 double *ay);

/* Adds the derivatives of sum_k phi_k q_k in free motion: sums[n] += sum_k phi_k d^n q_k / dt^n, by
 * q'' = -2 damping omega q' - omega^2 q. */
enum { DERIVATIVES = 16 };
void kernel_derivatives(size_t length, const double *omega, const double *damping,
                        const double *phi, const double *q, const double *v,
                        double sums[DERIVATIVES]);

/* sums[i][j] += sum_k phi_a_k phi_b_k response[i][j]_k. */
void kernel_response(const struct step_table *table, size_t length, const double *phi_a,
                     const double *phi_b, double sums[NODES][NODES]);

/* A contact's forces at the nodes, and how they reach the modes. */
struct kernel_load {
    const double *phi;   /* [length] */
    const double *force; /* [NODES] */
};

/* What dampers take on the step: sum_k of the table's quadratic form of (q_k, v_k, f_1..f_4), f_j
 * the sum over the loads of phi_k force_j. Damped tables only. */
double kernel_loss(const struct step_table *table, size_t length, const double *const state[2],
                   const struct kernel_load *loads, size_t count);

#endif
