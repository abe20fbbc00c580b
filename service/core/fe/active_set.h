/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Frictionless contact of nodes that open or press. */
#ifndef PERCUSS_FE_ACTIVE_SET_H
#define PERCUSS_FE_ACTIVE_SET_H

#include <stdbool.h>
#include <stddef.h>

enum active_set_kind {
    ACTIVE_SET_BY_INDENTATION, /* `indentation` is given */
    ACTIVE_SET_BY_TOTAL,       /* `total` is given */
    ACTIVE_SET_BY_EDGE         /* nodes 0 ... edge touch, the force of `edge` is 0 */
};

/* Nodes with gap_i = initial_i - indentation + sum_j compliance_ij force_j: force >= 0, gap >= 0,
 * one of them 0 (by edge: the nodes beyond it are not looked at). */
struct active_set {
    enum active_set_kind kind;
    size_t count;
    const double *compliance; /* count x count, row-major */
    const double *initial;
    double indentation, total; /* one given, the other found; by edge both found */
    size_t edge;
    double *force;    /* found */
    bool *active;     /* a guess, then the answer */
    double stiffness; /* found: d total / d indentation of the active nodes */
    double *scratch;  /* (count + 1) * (count + 3) */
};

/* False: no consistent set was found, or a singular matrix. */
bool active_set_solve(struct active_set *set);

#endif
