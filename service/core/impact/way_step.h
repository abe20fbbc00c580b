/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The equations of a step of contacts of which one or more have a force that depends on their way
 * (impact/way_contact.h): for contact a at a point i of the step, a node or its end,
 *
 *   d_ai = target_ai - sum_bj coupling_ab,ij F_bj       F_a = law_a(d_a, rates of the approach)
 *
 * by Newton's method for the forces of all contacts at all points. */
#ifndef PERCUSS_IMPACT_WAY_STEP_H
#define PERCUSS_IMPACT_WAY_STEP_H

#include "impact/scene.h"
#include "impact/way_contact.h"

/* Reduction of an indentation at a point by a unit force at another one, m/N: the end has the
 * residual flexibility alone. */
struct way_block {
    double by[STEP_POINTS][STEP_POINTS];
};

struct way_step {
    const struct scene *scene;
    struct way_contact *contact; /* [contacts] */
    struct way_slopes slopes;
    /* of the step to be solved, [contact]: d and the approach at the points without the contacts'
     * forces */
    double (*target)[STEP_POINTS], (*approach)[STEP_POINTS];
    double (*excess)[STEP_POINTS];           /* [contact]: of the forces over the law's */
    size_t *press, pressed;                  /* contacts that press: Newton's system is theirs, */
    double *matrix, (*change)[STEP_POINTS];  /* with the changes of their forces */
    double *present;                         /* [contact]: forces where the step begins, N */
    struct way_block *coupling[STEP_LEVELS]; /* [contacts^2]; NULL: not yet */
    int level;                               /* of the step just solved */
};

/* NULL: the force of each contact depends on its indentation alone. False: out of memory. */
bool way_step_create(struct way_step **step, const struct scene *scene, struct arena *arena);

/* Makes sure of a level, which the scene's tables have. False: out of memory. */
bool way_step_prepare(struct way_step *step, int level, struct arena *arena);

/* Solves a step of a prepared level from starting values of the indentations at the nodes,
 * [contact], to a relative change of the forces below `last`. False: no solution. */
bool way_step_solve(struct way_step *step, int level, double (*const indentation)[NODES],
                    double last, unsigned long *iterations);

/* Accepts the step just solved, which began at `time`, for a contact of a lossy law. */
void way_step_take(struct way_step *step, size_t contact, double time);

/* What all of these have lost so far, with these indentations, J. */
double way_step_lost(const struct way_step *step, const double *indentation);

#endif
