/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the bodies' vibration at the stated instant is wrong by, as the answer that left it was, and
 * what that does to this answer. */
#ifndef PERCUSS_SOLVE_START_ERROR_H
#define PERCUSS_SOLVE_START_ERROR_H

#include "solve/solution.h"

struct start_error {
    double restitution; /* by the errors of modes and steps of the answers before */
    double model;       /* and by their models' */
    /* J, what either does to the vibration of a body by the forces that it changes */
    double vibration[2][PERCUSS_MAX_BODIES];
};

/* Solutions beside the answer, whose vibration begins as wrong as the states say. Zero where none
 * of them says so. PERCUSS_OK, PERCUSS_INTERNAL or PERCUSS_TIMEOUT. */
enum percuss_status start_error_find(const struct problem *problem, const struct solution *solution,
                                     struct pace *pace, struct start_error *error);

/* Shares of the impulses that this answer may be wrong by: modes and steps with what the start
 * does, and the models'. */
struct start_shares {
    double numerical, model;
};

/* What the vibration of a body after the answer is wrong by, as shares of its amplitudes, for its
 * new state. */
void start_error_after(const struct problem *problem, const struct solution *solution,
                       const struct start_error *start, const struct start_shares *shares,
                       size_t body, struct body_state *state);

#endif
