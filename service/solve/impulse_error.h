/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the impulses of an answer and the velocities that they leave may be wrong by. Of a group the
 * error of the restitution says little of either: it is that of the contact where it is largest,
 * over an impulse of compression that may be next to nothing.
 *
 * A contact alone has the error of its restitution times its impulse of compression. Each contact
 * of a group has the distances of its own impulse from those of the solutions beside the answer
 * (nearby.h, model_error.h), and what bodies' states are wrong by as its restitution would have it.
 * A body's velocity may be wrong by what the errors of all its contacts make of it together. */
#ifndef PERCUSS_SOLVE_IMPULSE_ERROR_H
#define PERCUSS_SOLVE_IMPULSE_ERROR_H

#include "solve/model_error.h"
#include "solve/result.h"

/* Of an answer whose errors of the restitution are filled. `start`: what the states' models have of
 * the models' error of the restitution. */
void impulse_error_report(const struct problem *problem, const struct solution *solution,
                          const struct model_error *model, double start,
                          struct solve_result *result);

/* Of a single contact: by the total error of its restitution. */
void impulse_error_alone(const struct problem *problem, struct solve_result *result);

#endif
