/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How many modes of a body a scene needs, and which of them. Of a mesh's, which are all in one
 * family, a place may excite a few only: those along a bar, or those that bend it in one plane. */
#ifndef PERCUSS_SOLVE_MODE_CHOICE_H
#define PERCUSS_SOLVE_MODE_CHOICE_H

#include "impact/scene.h"
#include "solve/prepared.h"
#include "solve/problem.h"

/* Most modes of one family of one body. */
enum { MODE_CHOICE_MOST = 5000 };

/* From the lowest up, until they exceed `cut`, are `most`, or those left would change the
 * restitution by less than `allowed`, as far as the collision of the rigid masses tells. */
struct mode_choice {
    double cut; /* rad/s */
    double allowed;
    size_t most;  /* at most MODE_CHOICE_MOST */
    bool unfixed; /* a number that the catalogue fixes is the least, not the one */
};

/* The number of modes of a loaded family of a body; `scene` needs no groups yet. More than
 * MODE_CHOICE_MOST: out of memory. compliance[row] becomes the family's own of those rows that it
 * was asked of on the way. */
size_t mode_choice_count(const struct mode_choice *choice, const struct problem *problem,
                         const struct scene *scene, size_t body, size_t family, double *compliance);

/* Leaves out of a group of `family`, with its participations, the modes that hardly take
 * part and that do not vibrate in `state` (NULL: at rest), with all their effects; *source becomes
 * the group of those that stay. The others move e by less than 1e-4 of the tolerance over 2
 * e, in a single blow. False: out of memory. */
bool mode_choice_leave_out(const struct problem *problem, const struct body_state *state,
                           size_t family, const struct prepared_group **source,
                           struct scene_group *group);

/* Whether the slow modes of a body that a contact's load acts on get so much that sub-impacts are
 * to be expected. */
bool mode_choice_returns(const struct problem *problem, size_t contact, size_t body, size_t family);

#endif
