/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The nonlinear equations of one contact step: indentations d at the nodes of all contacts,
 *
 *   e_ai(d) = d_ai + sum_bj coupling_ab,ij F_b(d_bj) - target_ai = 0
 *
 * for contact a at node i. Newton's method, (1 + coupling F') change = e, d -= change, contact by
 * contact: within one short step the coupling between contacts is weak, so that each uses the
 * others' forces of the iteration before. Where it is strong, all contacts are solved at once. */
#ifndef PERCUSS_IMPACT_NODE_SOLVER_H
#define PERCUSS_IMPACT_NODE_SOLVER_H

#include <math.h>
#include <stdbool.h>

#include "impact/coupling.h"

struct node_problem {
    const struct scene *scene;
    const struct coupling *coupling; /* prepared for the level */
    int level;
    const double (*target)[STEP_POINTS]; /* [row]: approaches without force, the nodes' */
    double (*taken)[STEP_POINTS];        /* [row]: scratch */
    double last_change; /* the iteration ends with a relative change of the indentations below */
};

/* Newton's method squares the relative change (the force is smooth on the scale of the
 * indentation): the change after which the forces have a relative accuracy. */
static inline double node_solver_last_change(double accuracy)
{
    /* the square has a factor of the order of one, and the forces sum up several of them */
    static const double RESERVE = 0.1;
    /* the error after that change is rounding */
    static const double SMALLEST = 1e-7;
    double change = RESERVE * sqrt(accuracy);
    return change > SMALLEST ? change : SMALLEST;
}

/* [row][node], of the contacts' normals: `indentation` holds starting values and becomes the
 * solution, `force` belongs to it, `stiffness` to the values before its last change. The forces of
 * tangents are given. False: no convergence with contacts taken
 * one by one; the values are then invalid. Adds to *iterations. */
bool node_solve(const struct node_problem *problem, double (*indentation)[NODES],
                double (*force)[NODES], double (*stiffness)[NODES], unsigned long *iterations);

/* The same, all contacts at once. `matrix`: (contacts NODES)^2, scratch. */
bool node_solve_together(const struct node_problem *problem, double *matrix,
                         double (*indentation)[NODES], double (*force)[NODES],
                         double (*stiffness)[NODES], unsigned long *iterations);

/* One contact's linear equations: (1 + m K) x = b with its own coupling m and the law's stiffnesses
 * K at the nodes. False: m K is too large for elimination in the order of the nodes, and x of no
 * use. */
bool node_solve_linear(const double (*m)[NODES], const double stiffness[NODES],
                       const double b[NODES], double x[NODES]);

enum { NODE_LINEAR_RIGHT = 4, NODE_LINEAR_ROWS = COUPLING_FEW * NODES };

/* A row of the matrix, and the right sides that become the solutions. */
struct node_linear_row {
    double matrix[NODE_LINEAR_ROWS];
    double right[NODE_LINEAR_RIGHT];
};

struct node_linear {
    size_t count;                 /* contacts */
    size_t contact[COUPLING_FEW]; /* their indices in the scene */
    struct node_linear_row row[NODE_LINEAR_ROWS];
};

/* Fills in the matrix for the contacts that are named; `stiffness` by contact of the scene. The
 * coupling is one by blocks (coupling.h), prepared for the level. */
void node_linear_fill(struct node_linear *linear, const struct coupling *coupling, int level,
                      double (*const stiffness)[NODES]);

/* Solves the equations. False: the coupling is too strong for elimination in the order of the
 * nodes. */
bool node_linear_solve(struct node_linear *linear);

#endif
