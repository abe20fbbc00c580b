/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Sensitivity of a solution to a small change of its contact, to first order or to second: the
 * linearised equations along the logged forces, through all sub-impacts. Laws begin and end without
 * stiffness, so that the instants of touch and release need no terms of their own. */
#ifndef PERCUSS_IMPACT_SENSITIVITY_H
#define PERCUSS_IMPACT_SENSITIVITY_H

#include "impact/force_log.h"
#include "impact/motion.h"

/* The change of the contact. */
struct sensitivity_source {
    double force;      /* logarithm of the law's force */
    double compliance; /* in series, m/N */
    /* of a displacement -viscosity F' - inertia F'' under a slow force F: m s/N, m s^2/N */
    double viscosity, inertia;
    bool curved; /* to second order, too: only force and compliance, a law like d^(3/2) */
};

/* The effect of the change. */
struct sensitivity {
    double impulse;   /* change of the contact's, N s */
    double curvature; /* its second derivative by the size of the change; 0: not requested */
    double largest;   /* largest magnitude of `impulse` after a sub-impact */
    double strain; /* largest change of a sub-impact's impulse, by either order, over that impulse:
                      the orders suffice where it is far below 1; INFINITY: the steps could not be
                      followed */
    struct motion motion; /* change of the motion at the end of the last contact, first order */
};

/* Data common to all sources along the log of a solution by impact_modal, of a scene with one
 * contact that did not yield. It lies in the arena, like scene and log; NULL: out of memory. */
struct sensitivity_path;
struct sensitivity_path *sensitivity_path_create(const struct scene *scene,
                                                 const struct force_log *log, struct arena *arena);

/* Follows the source along the path. OK, INTERNAL without memory (path NULL is such), or TIMEOUT
 * where the pace stopped it. */
enum percuss_status sensitivity_follow(struct sensitivity_path *path,
                                       const struct sensitivity_source *source, struct pace *pace,
                                       struct sensitivity *tangent);

/* Energy of the change of a body's vibration, J, for a source of unit size. */
double sensitivity_vibration(const struct sensitivity_path *path, const struct sensitivity *tangent,
                             size_t body);

#endif
