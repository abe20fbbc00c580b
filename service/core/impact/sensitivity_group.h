/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* As sensitivity.h, for several coupled contacts (up to COUPLING_FEW): the linearised equations
 * along the forces of all of them, for small changes of all of them at once. */
#ifndef PERCUSS_IMPACT_SENSITIVITY_GROUP_H
#define PERCUSS_IMPACT_SENSITIVITY_GROUP_H

#include "impact/node_solver.h"
#include "impact/sensitivity.h"

/* Changes that are followed side by side: their common data are computed once. */
enum { TANGENT_GROUP_MOST = NODE_LINEAR_RIGHT };

struct sensitivity_group_task {
    const struct scene *scene;
    const struct force_log *log; /* of a solution of it by impact_modal, in which nothing yielded */
    size_t count;
    const struct sensitivity_source *source[TANGENT_GROUP_MOST]; /* [contact] */
};

/* The effect of a change. */
struct sensitivity_group {
    double impulse[PERCUSS_MAX_CONTACTS]; /* change of each contact's, N s */
    /* Largest change of a sub-impact's impulse over that impulse, or over a small share of the
     * group's largest impulse, since grazes come and go; INFINITY: a step could not be followed */
    double strain;
};

/* Follows them: tangent, [task->count]. OK, INTERNAL without memory, or TIMEOUT where the pace
 * stopped it. */
enum percuss_status sensitivity_group_follow(const struct sensitivity_group_task *task,
                                             struct arena *arena, struct pace *pace,
                                             struct sensitivity_group *tangent);

#endif
