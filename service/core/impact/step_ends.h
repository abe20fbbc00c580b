/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The steps in which a contact begins or ends. Its force is there as the 3/2 power of the time from
 * the touch, or to the release, and what the four nodes see of it has neither its impulse (7e-5 of
 * a step's are missed where it begins, 1e-3 where it ends) nor what it does to the modes. The
 * indentation has no such kink, as the force acts on it by its double integral: the law's force
 * along it tells what the nodes miss. */
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

/* At the end of a step of length h: derivatives of the cubic through its nodes. */
struct contact_start step_values_after(const struct step_values *values, double h);

/* When a closed contact would open as it moves now, along a parabola; INFINITY: never. */
double step_values_opens(const struct contact_start *now);

/* One contact on such a step. */
struct step_end {
    const struct contact_law *law;
    double compliance;         /* in series with it, m/N */
    struct step_values values; /* as they were solved for */
};

/* Share of the step after which the contact is open: the last zero of the polynomial of degree five
 * through the values, of which the last is not positive. */
double step_ends_release(const struct step_values *values);

/* Share of the step before which the contact is open: 0 where it begins with the step, else the
 * first zero of that polynomial. */
double step_ends_touch(const struct step_values *values);

/* Where the contact begins on a step or ends on it, the forces at its
 * nodes become those of the cubic with the moments, up to the third, of the law's force along the
 * indentation. False: it does neither, or both, or opens in between: they stay as they are. */
bool step_ends_project(const struct step_end *step, double force[NODES]);

/* The same of each contact on a step that was solved, from where they are `now`, [contact]. False:
 * of none. What others' forces do through the residual flexibility is as smooth as its cubic. */
bool step_ends_project_all(const struct scene *scene, const struct contact_start *now,
                           struct contact_step *step);

#endif
