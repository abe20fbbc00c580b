/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* More modes and shorter time steps until their errors fit the tolerance. A sequence of sub-impacts
 * amplifies the errors of the first ones, and not evenly: its error comes from first order along
 * the answer, or from other solutions. */
#ifndef PERCUSS_SOLVE_ERROR_REFINEMENT_H
#define PERCUSS_SOLVE_ERROR_REFINEMENT_H

#include "solve/error/attempt.h"
#include "solve/error/budget.h"

/* Most modes of a family of a body that are tried. */
enum { REFINEMENT_MOST_MODES = 1200 };

/* Whether a contact bends a beam, or there are several: then a sequence of sub-impacts is likely,
 * which amplifies every error. */
bool refinement_expects_sequence(const struct problem *problem);

/* Solves with as few modes as the tolerance allows; best->accuracy is given. PERCUSS_OK,
 * PERCUSS_INTERNAL or PERCUSS_TIMEOUT. An overlap without a touch before
 * (outcome.always_overlapped) ends it. */
enum percuss_status refine_modes(struct attempt_context *context, struct attempt *best,
                                 struct mode_error *error);

/* Solves the attempt's scene again with shorter steps if their error is too large. `modes`: the
 * error known already, as longer steps than its own are. PERCUSS_OK, PERCUSS_INTERNAL or
 * PERCUSS_TIMEOUT. */
enum percuss_status refine_steps(struct attempt_context *context, struct attempt *best,
                                 const struct mode_error *modes, struct step_error *error);

/* Compares a sequence with other solutions; `error` holds the estimate without them, and is
 * widened. PERCUSS_OK, PERCUSS_INTERNAL or PERCUSS_TIMEOUT. */
enum percuss_status refinement_compare(struct attempt_context *context, struct attempt *best,
                                       struct mode_error *error);

#endif
