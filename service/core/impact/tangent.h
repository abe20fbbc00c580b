/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a small change of a contact does to a solution of it, to first order or to second: the
 * linearised equations along the forces that were taken down, through all of its sub-impacts. Laws
 * begin and end without stiffness, so that the instants of touch and release need no terms of their
 * own. */
#ifndef PERCUSS_IMPACT_TANGENT_H
#define PERCUSS_IMPACT_TANGENT_H

#include "impact/force_log.h"
#include "impact/motion.h"

/* The change. */
struct tangent_source {
    double force;      /* logarithm of the law's force */
    double compliance; /* in series, m/N */
    /* what answers a slow force F with a displacement -viscosity F' - inertia F'': m s/N, m s^2/N
     */
    double viscosity, inertia;
    bool curved; /* to second order, too: of force and compliance, by a law like d^(3/2) */
};

/* What it does. */
struct tangent {
    double impulse;       /* to the contact's, N s */
    double curvature;     /* its second derivative by the size of the change; 0: not asked for */
    double largest;       /* the largest of what the first is after each sub-impact */
    double strain;        /* largest change of a sub-impact's impulse, by either order, over that
                             impulse: they are enough where it is far below 1; INFINITY: it could not
                             be followed */
    struct motion motion; /* of the scene at the end of the last contact, by the first */
};

/* What every source meets along the log of a solution of the scene by impact_modal: one contact,
 * which did not yield. From the arena, as scene and log are; NULL: out of memory. */
struct tangent_path;
struct tangent_path *tangent_path_create(const struct scene *scene, const struct force_log *log,
                                         struct arena *arena);

/* Follows the source along the path. OK, INTERNAL without memory (path NULL is such), or TIMEOUT
 * where the pace stopped it. */
enum percuss_status tangent_follow(struct tangent_path *path, const struct tangent_source *source,
                                   struct pace *pace, struct tangent *tangent);

/* Energy of what it does to the vibration of a body, J, after a source of unit size. */
double tangent_vibration(const struct tangent_path *path, const struct tangent *tangent,
                         size_t body);

#endif
