/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Propagates the modes through a contact from step to step. Undamped modes are kept at the middle
 * of the step (enum middle_term): one pass applies the last step's forces, turns the modes to the
 * next step and sums the displacements there. Damped modes stay in the motion. */
#ifndef PERCUSS_IMPACT_MIDPOINT_H
#define PERCUSS_IMPACT_MIDPOINT_H

#include "impact/motion.h"

struct midpoint {
    double **q, **v; /* [group][stride], of undamped modes at the middle of the step */
    bool damped;     /* some mode is damped */
    bool nodes_only; /* the sums at the ends of the steps may be omitted */
    int level;       /* of that step; < 0: the motion holds all modes */
    /* [row]: of that step if it was taken, not applied yet; NULL: it was not taken */
    const double (*force)[NODES];
};

/* Memory for a scene from the arena. False: out of memory. */
bool midpoint_create(struct midpoint *midpoint, const struct scene *scene, struct arena *arena);

/* Moves the modes from the present to a step of `level`, which has tables: sums[row] becomes
 * the modes' part of minus the approach at the nodes and the end if no force acts. */
void midpoint_enter(struct midpoint *midpoint, const struct scene *scene,
                    const struct motion *motion, int level, double (*sums)[STEP_POINTS]);

/* Takes the entered step with these forces, which must persist until the next call: the motion
 * becomes that at its end, except for undamped modes. */
void midpoint_take(struct midpoint *midpoint, const struct scene *scene, struct motion *motion,
                   double (*const force)[NODES]);

/* Writes undamped modes to the motion. */
void midpoint_leave(struct midpoint *midpoint, const struct scene *scene, struct motion *motion);

#endif
