/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The nonlinear equations of one contact step: indentations at the nodes of all active contacts. */
#ifndef PERCUSS_IMPACT_NODE_SOLVER_H
#define PERCUSS_IMPACT_NODE_SOLVER_H

#include <math.h>
#include <stdbool.h>

#include "impact/scene.h"

struct node_problem {
    const struct contact_law *laws; /* [all contacts] */
    size_t contacts;                /* all */
    const size_t *list;             /* the active ones */
    size_t count;
    const double (*coupling)[NODES][NODES]; /* [contact a][contact b]: approach of a at node i by
                                               the force of b at node j, m/N */
    const double (*target)[NODES];          /* [active]: approaches without force */
    double *matrix, *residual;              /* scratch: (count NODES)^2, count NODES */
    double last_change; /* the iteration ends with a relative change of the indentations below */
};

/* Newton's method squares the relative change (the force is smooth on the scale of the
 * indentation): the change after which the forces have a relative accuracy. */
static inline double node_solver_last_change(double accuracy)
{
    double change = 0.1 * sqrt(accuracy);
    return change > 1e-7 ? change : 1e-7; /* what is left after that is rounding */
}

/* Newton's method for indentation_i + sum coupling force(indentation) = target. [all
 * contacts][node] `indentation` holds starting values and becomes the solution, `force` belongs to
 * it. False: no convergence. Adds to *iterations. */
bool node_solve(const struct node_problem *problem, double (*indentation)[NODES],
                double (*force)[NODES], double (*stiffness)[NODES], unsigned long *iterations);

#endif
