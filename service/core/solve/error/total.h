/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Adds the errors of an answer up.
 *
 * The impulse of a single contact has the error of its restitution times its impulse of
 * compression. Of a group that error says little: it is that of the contact where it is largest,
 * over an impulse of compression that may be next to nothing. Each contact of a group has the
 * distances of its own impulse from those of other solutions (neighbours.h, models.h), and the
 * error of the bodies' states as its restitution has it. A body's velocity may be wrong by the
 * effect of all its contacts together. */
#ifndef PERCUSS_SOLVE_ERROR_TOTAL_H
#define PERCUSS_SOLVE_ERROR_TOTAL_H

#include "solve/result.h"
#include "solve/solution.h"

/* Estimates the errors of the models and of the states of a solution, which has those of modes and
 * steps; `states`: false where they count as known. PERCUSS_OK, PERCUSS_INTERNAL or
 * PERCUSS_TIMEOUT. */
enum percuss_status total_find(const struct problem *problem, struct solution *solution,
                               bool states, struct pace *pace);

/* Fills the errors of the restitution, of the contacts' impulses, of the bodies' velocities and of
 * their new states, and whether the tolerance is met, in a result that has its contacts and bodies.
 */
void total_report(const struct problem *problem, const struct solution *solution,
                  struct solve_result *result);

/* The same of a single contact without a solution, from result->restitution_time and
 * restitution_modes: with a model error of the restitution, `yield` of it by metals of unstated
 * yield, at most `range`. */
void total_report_model(const struct problem *problem, double model, double yield, double range,
                        struct solve_result *result);

#endif
