/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The linear equations of a step of few contacts, all at once:
 *
 *   d_ai + sum_bj coupling_ab,ij K_bj d_bj = right_ai
 *
 * for the contacts that bear a force, with the laws' stiffnesses K at the nodes, and for several
 * right sides side by side. */
#ifndef PERCUSS_IMPACT_NODE_LINEAR_H
#define PERCUSS_IMPACT_NODE_LINEAR_H

#include <stdbool.h>

#include "impact/coupling.h"

enum { NODE_LINEAR_RIGHT = 4, NODE_LINEAR_ROWS = COUPLING_FEW * NODES };

/* A row of the matrix, and the right sides that become the solutions. */
struct node_linear_row {
    double matrix[NODE_LINEAR_ROWS];
    double right[NODE_LINEAR_RIGHT];
};

struct node_linear {
    size_t count;                 /* contacts */
    size_t contact[COUPLING_FEW]; /* which they are */
    struct node_linear_row row[NODE_LINEAR_ROWS];
};

/* Fills in the matrix for the contacts that are named; `stiffness` by contact of the scene. The
 * coupling is one by blocks (coupling.h), prepared for the level. */
void node_linear_fill(struct node_linear *linear, const struct coupling *coupling, int level,
                      double (*const stiffness)[NODES]);

/* Solves it. False: the coupling is too strong for elimination in the order of the nodes. */
bool node_linear_solve(struct node_linear *linear);

#endif
