/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A whole scene as one system of ordinary differential equations, for a general solver.
 *
 * y: [contacts] gaps, [contacts] gap rates, [contacts] impulses, 1 damping loss, then every group's
 * q and v. Root functions: per contact the local indentation, the approach rate and, where a law
 * yields, the indentation above the limit of what can be undone. */
#ifndef PERCUSS_IMPACT_REFERENCE_SYSTEM_H
#define PERCUSS_IMPACT_REFERENCE_SYSTEM_H

#include "impact/motion.h"

struct reference_system {
    const struct scene *scene;
    size_t roots;                                           /* root functions of a contact */
    size_t size;                                            /* of y */
    struct motion motion;                                   /* a state unpacked */
    double *approach, *rate, *indentation, *force, *matrix; /* [contact]; matrix: contacts^2 */
    double *absolute;                                       /* [size] absolute tolerances */
    double *absolute_force; /* [contact] of a collision with all the energy, N */
};

/* False: out of memory. */
bool reference_system_create(struct reference_system *system, const struct scene *scene,
                             struct arena *arena);

void reference_system_pack(const struct reference_system *system, const struct motion *motion,
                           double *y);
void reference_system_unpack(const struct reference_system *system, const double *y,
                             struct motion *motion);

/* Finds motion, approaches, local indentations and forces of a state. */
void reference_system_forces(struct reference_system *system, const double *y);

/* dy/dt and the root functions, see ode.h; `context`: the system. */
void reference_system_rates(double t, const double *y, double *rate, void *context);
void reference_system_roots(double t, const double *y, double *values, void *context);

/* Absolute tolerances from the energy at hand in a motion, so that no unit is favoured. */
void reference_system_tolerate(struct reference_system *system, const struct motion *motion,
                               double relative);

#endif
