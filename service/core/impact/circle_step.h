/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Micro-slip of contacts whose laws have a loss on the steps of a contact phase: the circles of
 * contact/circles.h, walked along the polynomials through the step's start and nodes
 * (impact/slip_way.h) under the normal forces' cubics. What they lose is the work on the slip less
 * what they give back. */
#ifndef PERCUSS_IMPACT_CIRCLE_STEP_H
#define PERCUSS_IMPACT_CIRCLE_STEP_H

#include "contact/circles.h"
#include "impact/scene.h"
#include "impact/slip_way.h"

/* Of one contact. */
struct circle_step {
    const struct slip_points *points; /* borrowed */
    struct circles now;               /* at the present, */
    struct circles along, after;      /* at the last node and the end of the step under way */
    double slip[2][WAY_POINTS];       /* of that step, m */
    double work;                      /* on the slip so far, J */
    double time;                      /* of the present since the stated instant, s */
};

/* Forces of the tangents at a step's nodes, N, and their slopes, N/m: each by its own d, and by the
 * other's; and the stiffness of what sticks. */
struct circle_forces {
    double (*force)[NODES], (*stiffness)[NODES]; /* [2] */
    double *across, *stuck;                      /* [NODES] */
};

/* For friction `i` of a scene, with that many circles, from the arena; `points` are borrowed.
 * False: out of memory. */
bool circle_step_create(struct circle_step *step, const struct scene *scene, size_t i, size_t parts,
                        const struct slip_points *points, struct arena *arena);

/* A contact phase begins, at this time: as circles_touch. */
void circle_step_begin(struct circle_step *step, double depth, double time, double indentation,
                       const double displacement[2]);

/* Walks to the nodes, under the normal forces there. */
void circle_step_nodes(struct circle_step *step, const struct friction_way *way,
                       const double normal[NODES], const struct circle_forces *forces);

/* The same from the last node to the end. */
void circle_step_end(struct circle_step *step, const struct friction_way *way, double normal,
                     double force[2], double stiffness[2]);

/* The end becomes the present, of a step of that level with those forces of the tangents. */
void circle_step_take(struct circle_step *step, int level, double (*const force)[NODES]);

/* Lost so far, J. */
double circle_step_lost(const struct circle_step *step);

#endif
