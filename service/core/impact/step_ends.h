/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The steps in which a contact begins or ends. Its force goes there with the 3/2 power of the time
 * from the touch, or to the release. The cubic through the four nodes misses part of its impulse
 * (7e-5 of a step's where it begins, 1e-3 where it ends) and of its effect on the modes. The
 * indentation, with the force's double integral, has no such kink: the law's force along it gives
 * the missed part. */
#ifndef PERCUSS_IMPACT_STEP_ENDS_H
#define PERCUSS_IMPACT_STEP_ENDS_H

#include "contact/law.h"
#include "impact/collocation.h"
#include "impact/contact_step.h"

/* Indentation of a contact at the start, the nodes and the end of a step. */
struct step_values {
    double start, end;
    const double *nodes; /* [NODES] */
};

/* Share of the step up to the first and to the last instant with positive indentation, linear
 * between the nodes around it; 1 and 0: there is none. */
double step_values_closing(const struct step_values *values);
double step_values_release(const struct step_values *values);

/* Indentation and its derivatives at the end of a step of length h, by the cubic through its
 * nodes. */
struct contact_start step_values_after(const struct step_values *values, double h);

/* Time until a closed contact opens, along the parabola of its present motion; INFINITY: never. */
double step_values_opens(const struct contact_start *now);

/* One contact on such a step. */
struct step_end {
    const struct contact_law *law;
    double compliance;         /* in series with it, m/N */
    struct step_values values; /* of the solved step */
};

/* Share of the step after which the contact is open: the last zero of the polynomial of degree five
 * through the values, of which the last is not positive. */
double step_ends_release(const struct step_values *values);

/* Share of the step before which the contact is open: 0 where it begins with the step, else the
 * first zero of that polynomial. */
double step_ends_touch(const struct step_values *values);

/* Where the contact begins or ends on a step, its forces at the nodes become those of the cubic
 * with the moments, up to the third, of the law's force along the indentation. False, without
 * change: it does neither, or both, or opens in between. */
bool step_ends_project(const struct step_end *step, double force[NODES]);

/* The same for each contact on a solved step from the state `now`, [contact]. False: for none. The
 * others' forces act through the residual flexibility as smoothly as their cubics. */
bool step_ends_project_all(const struct scene *scene, const struct contact_start *now,
                           struct contact_step *step);

#endif
