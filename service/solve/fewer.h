/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A scene that was solved, once more with fewer modes: for solutions beside the answer, which need
 * to be much less accurate. */
#ifndef PERCUSS_SOLVE_FEWER_H
#define PERCUSS_SOLVE_FEWER_H

#include "impact/impact.h"
#include "solve/problem.h"

/* What modes that solutions beside a sequence lack may do to the impulse: sequences amplify that
 * five- to twentyfold as a rule. */
static const double FEWER_SEQUENCE = 1e-4;

/* The same of first order along a sequence, which is compared with nothing. */
static const double FEWER_FIRST_ORDER = 1e-3;

/* Leaves out the highest modes, whose inertia and viscosity would change no contact's impulse by
 * more than `allowed` of that of compression, as the answer's forces tell (mode_search.c); their
 * static compliance goes into `fewer->residual`. Modes in motion at the beginning stay. Arrays come
 * from the problem's arena, sets of modes from the scene. False: out of memory. */
bool fewer_modes(const struct problem *problem, const struct scene *scene,
                 const struct impact_outcome *answer, double allowed, struct scene *fewer);

#endif
