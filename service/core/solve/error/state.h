/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The error of the bodies' vibration at the stated instant, as the answer that left it had it, and
 * its effect on this answer. */
#ifndef PERCUSS_SOLVE_ERROR_STATE_H
#define PERCUSS_SOLVE_ERROR_STATE_H

#include "solve/solution.h"

/* Other solutions, with vibration that begins as wrong as the states say. Zero where none
 * of them says so. PERCUSS_OK, PERCUSS_INTERNAL or PERCUSS_TIMEOUT. */
enum percuss_status state_find_error(const struct problem *problem, const struct solution *solution,
                                     struct pace *pace, struct state_error *error);

/* Errors of this answer as shares of the impulses: modes and steps with the effect of the start,
 * and the models'. */
struct state_shares {
    double numerical, model;
};

/* The error of a body's vibration after the answer, as shares of its amplitudes, for its
 * new state. */
void state_error_after(const struct problem *problem, const struct solution *solution,
                       const struct state_shares *shares, size_t body, struct body_state *state);

#endif
