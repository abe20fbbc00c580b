/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Errors of the impulses of an answer and of the velocities that they leave. Of a group the
 * error of the restitution says little of either: it is that of the contact where it is largest,
 * over an impulse of compression that may be next to nothing.
 *
 * A contact alone has the error of its restitution times its impulse of compression. Each contact
 * of a group has the distances of its own impulse from those of other solutions (neighbours.h,
 * models.h), and the error of the bodies' states as its restitution has it. A body's velocity may
 * be wrong by the effect of all its contacts together. */
#ifndef PERCUSS_SOLVE_ERROR_IMPULSES_H
#define PERCUSS_SOLVE_ERROR_IMPULSES_H

#include "solve/error/models.h"
#include "solve/result.h"

/* Of an answer that has its errors of the restitution. `start`: the states' part of the
 * models' error of the restitution. */
void impulse_error_report(const struct problem *problem, const struct solution *solution,
                          const struct model_error *model, double start,
                          struct solve_result *result);

/* Of a single contact: by the total error of its restitution. */
void impulse_error_alone(const struct problem *problem, struct solve_result *result);

#endif
