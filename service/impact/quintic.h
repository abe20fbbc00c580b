/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The polynomial of degree five by a contact's values at the nodes, at the start and at the end of
 * a step:
 *
 *   p(s) = sum_j value_j L_j(s) + (low + (high - low) s) prod_j (s - node_j). */
#ifndef PERCUSS_IMPACT_QUINTIC_H
#define PERCUSS_IMPACT_QUINTIC_H

#include "impact/collocation.h"

/* The product of the nodes: that of (s - node_j) at both ends of the step. */
static const double QUINTIC_PRODUCT = 1.0 / 70.0;

struct quintic {
    const double *nodes; /* [NODES] */
    double low, high;
};

/* Lagrange's polynomials of the nodes at s, and the product. */
struct quintic_basis {
    double s, product;
    double by[NODES];
};

static inline struct quintic quintic_through(double start, const double nodes[NODES], double end)
{
    double at_start = 0.0;
    double at_end = 0.0;
    for (int j = 0; j < NODES; j++) {
        at_start += nodes[j] * collocation.monomial[j][0];
        at_end += nodes[j] * collocation.end[0][j];
    }
    return (struct quintic){nodes, (start - at_start) / QUINTIC_PRODUCT,
                            (end - at_end) / QUINTIC_PRODUCT};
}

static inline struct quintic_basis quintic_basis_at(double s)
{
    struct quintic_basis basis = {.s = s, .product = 1.0};
    for (int j = 0; j < NODES; j++) {
        const double *c = collocation.monomial[j];
        basis.by[j] = ((c[3] * s + c[2]) * s + c[1]) * s + c[0];
        basis.product *= s - collocation.node[j];
    }
    return basis;
}

static inline double quintic_value(const struct quintic *quintic, const struct quintic_basis *basis)
{
    double sum = (quintic->low + (quintic->high - quintic->low) * basis->s) * basis->product;
    for (int j = 0; j < NODES; j++)
        sum += quintic->nodes[j] * basis->by[j];
    return sum;
}

#endif
