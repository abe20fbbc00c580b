/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The fast time scale of one contact with a static finite-element region, solved in every time step
 * (concurrent finite elements). Modes, rigid motion and flights are as in impact_modal. */
#ifndef PERCUSS_IMPACT_CONCURRENT_H
#define PERCUSS_IMPACT_CONCURRENT_H

#include "base/fault.h"
#include "fe/region.h"
#include "impact/impact.h"

struct concurrent_settings {
    double horizon; /* s from the stated instant */
    unsigned steps; /* of a contact, at least; twice as many at most */
    struct pace *pace;
    double done; /* share of the work before this solution, for the pace */
};

/* Solves a scene of one contact. A region of virgin bodies gives the indentation instead of the
 * law; the scene's law gives scales only and takes the history. The force is linear on a step:
 * second order in its length. `outcome` comes from impact_create. OK; INTERNAL without memory or if
 * the region has no equilibrium; TIMEOUT if the pace stopped it. */
enum percuss_status impact_concurrent(const struct scene *scene, struct region *region,
                                      const struct concurrent_settings *settings,
                                      struct arena *arena, struct impact_outcome *outcome,
                                      struct fault *fault);

#endif
