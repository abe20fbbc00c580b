/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The indentation of one contact along one step: when it begins and ends, and how it goes on. */
#ifndef PERCUSS_IMPACT_STEP_VALUES_H
#define PERCUSS_IMPACT_STEP_VALUES_H

#include "impact/contact_step.h"

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

#endif
