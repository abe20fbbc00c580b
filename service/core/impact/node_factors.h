/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The matrix 1 + m K of one contact on a step, the stiffnesses K of its law at the nodes and its
 * own coupling m: rows, their elimination, and right sides. In the inner loop of every contact
 * phase. */
#ifndef PERCUSS_IMPACT_NODE_FACTORS_H
#define PERCUSS_IMPACT_NODE_FACTORS_H

#include <stdbool.h>

#include "impact/collocation.h"

/* Two nodes of a contact, at any address: every vector unit has this width. The lanes have the
 * order of operations of scalars. */
typedef double node_pair __attribute__((vector_size(2 * sizeof(double)), aligned(8)));
#define NODE_PAIR(at)       (*(node_pair *)(at))
#define NODE_CONST_PAIR(at) (*(const node_pair *)(at))

/* Result of a comparison of two nodes. */
typedef long long pair_mask __attribute__((vector_size(2 * sizeof(long long))));

/* A row's lanes 0, 1 and 2, 3. */
struct node_row {
    node_pair low, high;
};

/* Row i of the matrix coupling F'. Returns the decrease of the approach by the forces, in two
 * parts. */
static inline node_pair node_row_of(const double coupling[NODES], const double force[NODES],
                                    const double stiffness[NODES], struct node_row *row)
{
    const node_pair low = NODE_CONST_PAIR(coupling);
    const node_pair high = NODE_CONST_PAIR(coupling + 2);
    node_pair moved = low * NODE_CONST_PAIR(force) + high * NODE_CONST_PAIR(force + 2);
    row->low = low * NODE_CONST_PAIR(stiffness);
    row->high = high * NODE_CONST_PAIR(stiffness + 2);
    return moved;
}

static inline void node_rows_add_one(struct node_row matrix[NODES])
{
    matrix[0].low += (node_pair){1.0, 0.0};
    matrix[1].low += (node_pair){0.0, 1.0};
    matrix[2].high += (node_pair){1.0, 0.0};
    matrix[3].high += (node_pair){0.0, 1.0};
}

/* The rows of the matrix 1 + m K. */
static inline void node_rows_make(const double (*m)[NODES], const double stiffness[NODES],
                                  struct node_row matrix[NODES])
{
    static const double none[NODES];
    node_row_of(m[0], none, stiffness, &matrix[0]);
    node_row_of(m[1], none, stiffness, &matrix[1]);
    node_row_of(m[2], none, stiffness, &matrix[2]);
    node_row_of(m[3], none, stiffness, &matrix[3]);
    node_rows_add_one(matrix);
}

/* Below this pivot (1 without coupling) elimination without exchanges loses a digit. */
static const double LEAST_PIVOT = 0.1;

/* The factors below the diagonal, above it, and on it. */
struct node_factors {
    double lower[NODES * (NODES - 1) / 2], upper[NODES * (NODES - 1) / 2];
    double reciprocal[NODES - 1], last; /* of the pivots but the last, and that */
    bool sound;                         /* no pivot is too small for the order of the nodes */
};

/* Eliminates the identity plus a small causal matrix in the given order, without exchanges. After a
 * pivot that is too small (`sound` false) the factors are not used. */
static inline struct node_factors node_factors_make(const struct node_row a[NODES])
{
    struct node_factors f;
    f.reciprocal[0] = 1.0 / a[0].low[0];
    f.lower[0] = a[1].low[0] * f.reciprocal[0];
    f.lower[1] = a[2].low[0] * f.reciprocal[0];
    f.lower[2] = a[3].low[0] * f.reciprocal[0];
    double a11 = a[1].low[1] - f.lower[0] * a[0].low[1];
    double a21 = a[2].low[1] - f.lower[1] * a[0].low[1];
    double a31 = a[3].low[1] - f.lower[2] * a[0].low[1];
    node_pair r1 = a[1].high - f.lower[0] * a[0].high;
    node_pair r2 = a[2].high - f.lower[1] * a[0].high;
    node_pair r3 = a[3].high - f.lower[2] * a[0].high;
    f.reciprocal[1] = 1.0 / a11;
    f.lower[3] = a21 * f.reciprocal[1];
    f.lower[4] = a31 * f.reciprocal[1];
    r2 -= f.lower[3] * r1;
    r3 -= f.lower[4] * r1;
    f.reciprocal[2] = 1.0 / r2[0];
    f.lower[5] = r3[0] * f.reciprocal[2];
    f.last = r3[1] - f.lower[5] * r2[1];
    f.upper[0] = a[0].low[1];
    f.upper[1] = a[0].high[0];
    f.upper[2] = a[0].high[1];
    f.upper[3] = r1[0];
    f.upper[4] = r1[1];
    f.upper[5] = r2[1];
    f.sound = a[0].low[0] > LEAST_PIVOT && a11 > LEAST_PIVOT && r2[0] > LEAST_PIVOT &&
              f.last > LEAST_PIVOT;
    return f;
}

static inline void node_factors_solve(const struct node_factors *f, const double b[NODES],
                                      double x[NODES])
{
    double b1 = b[1] - f->lower[0] * b[0];
    double b2 = b[2] - f->lower[1] * b[0] - f->lower[3] * b1;
    double b3 = b[3] - f->lower[2] * b[0] - f->lower[4] * b1 - f->lower[5] * b2;
    x[3] = b3 / f->last;
    x[2] = (b2 - f->upper[5] * x[3]) * f->reciprocal[2];
    x[1] = (b1 - f->upper[4] * x[3] - f->upper[3] * x[2]) * f->reciprocal[1];
    x[0] = (b[0] - f->upper[2] * x[3] - f->upper[1] * x[2] - f->upper[0] * x[1]) * f->reciprocal[0];
}

#endif
