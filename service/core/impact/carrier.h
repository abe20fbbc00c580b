/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The modes on their way through a contact, from step to step. Undamped ones are known at the
 * middle of the step (enum middle_term), so that one pass over them applies the forces of the step
 * that was taken, goes on to the next and says where that leads; damped ones stay in the motion. */
#ifndef PERCUSS_IMPACT_CARRIER_H
#define PERCUSS_IMPACT_CARRIER_H

#include "impact/motion.h"

struct carrier {
    double **q, **v; /* [group][stride], of undamped modes at the middle of the step */
    bool damped;     /* any mode is */
    bool nodes_only; /* nobody asks for the ends of the steps: sums of theirs may be missing */
    int level;       /* of that step; < 0: all modes are as the motion says */
    /* [contact], of that step if it is behind them: still to be applied; NULL: it was not taken */
    const double (*force)[NODES];
};

/* Memory for a scene from the arena. False: out of memory. */
bool carrier_create(struct carrier *carrier, const struct scene *scene, struct arena *arena);

/* Goes on to a step of `level` from the present, whose tables are ready: sums[contact] becomes the
 * modes' part of minus the approach at its nodes and its end if no force acts on it. */
void carrier_enter(struct carrier *carrier, const struct scene *scene, const struct motion *motion,
                   int level, double (*sums)[STEP_POINTS]);

/* The step entered is taken with these forces, which must stay as they are until the next call:
 * the motion becomes that of its end but for undamped modes. */
void carrier_take(struct carrier *carrier, const struct scene *scene, struct motion *motion,
                  double (*const force)[NODES]);

/* The motion becomes whole again. */
void carrier_leave(struct carrier *carrier, const struct scene *scene, struct motion *motion);

#endif
