/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A single contact without micro-slip whose force depends on its way, on the steps of its contact
 * phase: one that remembers (impact/memory_step.h), or whose law has the rate of the indentation in
 * it. The force at a point of the step depends on the indentations at all of them.
 *
 * The rate is that of the approach, d + C F with the series compliance C: that of d alone would not
 * be defined by the present state, and with a negative C would grow without bounds. */
#ifndef PERCUSS_IMPACT_WAY_STEP_H
#define PERCUSS_IMPACT_WAY_STEP_H

#include "base/arena.h"
#include "impact/memory_step.h"
#include "impact/scene.h"

struct way_step {
    const struct contact_law *law;
    struct memory_step *memory; /* of a law that remembers, else NULL */
    double compliance;          /* in series, m/N */
    double approach;            /* d + compliance F where the step begins, m */
    int level;
    double indentation[STEP_POINTS], force[STEP_POINTS];
    double slope[STEP_POINTS][STEP_POINTS]; /* of a memory's forces by all indentations, N/m */
    double stiffness[STEP_POINTS];          /* of the forces by their own */
    bool parted;                            /* no force since, */
    double touched_at, parted_at;           /* the first force, and the end of the last one, s */
    double largest;                         /* force since the touch, N */
    double now;                             /* force at the present, N */
    double work;                            /* of all forces on the approach, J */
};

/* NULL: the force of each contact depends on its indentation alone. False: out of memory, or one of
 * them is refused (contact_law_refuses), which callers see to. */
bool way_step_create(struct way_step **step, const struct scene *scene, struct arena *arena);

/* Makes sure of a level. False: out of memory. */
bool way_step_prepare(struct way_step *step, int level, struct arena *arena);

/* The contact begins, or closes again. */
void way_step_begin(struct way_step *step, double time);

/* The equations of a step: d_i + sum_j coupling_ij F_j
 * = target_i at the nodes, at the end with the compliance's part beside them. To a relative change
 * of d below `last`. */
struct way_problem {
    int level;
    double last;
    const double (*coupling)[NODES]; /* [STEP_POINTS] */
    const double *target;            /* [STEP_POINTS] */
};

/* From starting values at the nodes, which become the solution. False: no solution. */
bool way_step_solve(struct way_step *step, const struct way_problem *problem,
                    double indentation[NODES], double force[NODES], unsigned long *iterations);

/* Whether the step just solved has a kink that the next one should begin with. */
bool way_step_bends(const struct way_step *step);

/* What the contact has taken of the work so far, less what it gives back at an indentation, J. */
double way_step_lost(const struct way_step *step, double indentation);

/* Accepts the step just solved, which began at `time` and ends with this rate. */
void way_step_take(struct way_step *step, double time, double end_rate, const double nodes[NODES],
                   const double forces[NODES]);

#endif
