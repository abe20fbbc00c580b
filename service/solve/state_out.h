/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Vibration and dents of the bodies after an impact. */
#ifndef PERCUSS_SOLVE_STATE_OUT_H
#define PERCUSS_SOLVE_STATE_OUT_H

#include "impact/impact.h"
#include "solve/assemble.h"

/* The state of a body at the end of the window: modes that took part from the outcome, the others
 * of its initial state moved on freely; dents unless the request ignores them. NULL: a rigid body
 * without dents, or out of memory. In the problem's arena. */
const struct body_state *state_after(const struct assembly *assembly,
                                     const struct impact_outcome *outcome,
                                     const struct problem *problem, size_t body);

#endif
