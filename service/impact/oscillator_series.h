/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Undamped oscillators on steps that are short for them: what the forces at the nodes of a step do,
 * by series in the square of the angle omega h. */
#ifndef PERCUSS_IMPACT_OSCILLATOR_SERIES_H
#define PERCUSS_IMPACT_OSCILLATOR_SERIES_H

#include <stdbool.h>

#include "impact/collocation.h"

enum { SERIES_ROWS = STEP_POINTS + 1 };

/* Whether the angle is small enough for it. */
bool oscillator_series_reaches(double angle);

/* by[point][j]: q at a node or the end by the force at node j; by[STEP_POINTS][j]: v at the end. */
void oscillator_series_response(double angle, double h, double by[SERIES_ROWS][NODES]);

#endif
