/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The fast scale of one contact whose force comes from a static finite-element region, solved in
 * every time step (concurrent finite elements): modes, rigid motion and flights as in impact_modal.
 */
#ifndef PERCUSS_IMPACT_CONCURRENT_H
#define PERCUSS_IMPACT_CONCURRENT_H

#include "base/fault.h"
#include "fe/region.h"
#include "impact/impact.h"

struct concurrent_settings {
    double horizon; /* s from the stated instant */
    unsigned steps; /* of a contact, at least; twice as many at most */
    struct pace *pace;
    double done; /* part of the whole work before this solution, which the pace is told */
};

/* Solves a scene of one contact with a region of virgin bodies, whose indentation takes the place
 * of the law's; the law of the scene gives scales only and takes the history. The force is linear
 * on a step: second order in its length. `outcome` comes from impact_create. OK; INTERNAL without
 * memory or where the region has no equilibrium; TIMEOUT where the pace stopped it. */
enum percuss_status impact_concurrent(const struct scene *scene, struct region *region,
                                      const struct concurrent_settings *settings,
                                      struct arena *arena, struct impact_outcome *outcome,
                                      struct fault *fault);

#endif
