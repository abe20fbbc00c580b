/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The error of the bodies' vibration at the stated instant, as the answer that left it had it, and
 * its effect on this answer. */
#ifndef PERCUSS_SOLVE_ERROR_STATE_H
#define PERCUSS_SOLVE_ERROR_STATE_H

#include "solve/solution.h"

struct start_error {
    double restitution; /* by the errors of modes and steps of the answers before */
    double model;       /* and by their models' */
    /* J, effect of either on the vibration of a body by the forces that it changes */
    double vibration[2][PERCUSS_MAX_BODIES];
};

/* Other solutions, with vibration that begins as wrong as the states say. Zero where none
 * of them says so. PERCUSS_OK, PERCUSS_INTERNAL or PERCUSS_TIMEOUT. */
enum percuss_status start_error_find(const struct problem *problem, const struct solution *solution,
                                     struct pace *pace, struct start_error *error);

/* Errors of this answer as shares of the impulses: modes and steps with the effect of the start,
 * and the models'. */
struct start_shares {
    double numerical, model;
};

/* The error of a body's vibration after the answer, as shares of its amplitudes, for its
 * new state. */
void start_error_after(const struct problem *problem, const struct solution *solution,
                       const struct start_error *start, const struct start_shares *shares,
                       size_t body, struct body_state *state);

#endif
