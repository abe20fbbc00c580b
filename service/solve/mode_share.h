/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What modes get of a blow. Of a mesh's, which are all in one family, a place may excite a few
 * only: those along a bar, or those that bend it in one plane. */
#ifndef PERCUSS_SOLVE_MODE_SHARE_H
#define PERCUSS_SOLVE_MODE_SHARE_H

#include "impact/scene.h"
#include "solve/prepared.h"
#include "solve/problem.h"

/* Leaves out of a group of `family`, whose participations are there, the modes that hardly take
 * part and that do not vibrate in `state` (NULL: at rest), with all that they do; *source becomes
 * the group of those that stay. What is left out moves e by less than 1e-4 of the tolerance over 2
 * e, in a single blow. False: out of memory. */
bool mode_share_leave_out(const struct problem *problem, const struct body_state *state,
                          size_t family, const struct prepared_group **source,
                          struct scene_group *group);

/* Whether the slow modes of a body that a contact's load acts on get so much that sub-impacts are
 * to be expected. */
bool mode_share_returns(const struct problem *problem, size_t contact, size_t body, size_t family);

#endif
