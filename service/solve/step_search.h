/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Shorter time steps until they matter less than the tolerance. */
#ifndef PERCUSS_SOLVE_STEP_SEARCH_H
#define PERCUSS_SOLVE_STEP_SEARCH_H

#include "solve/sequence.h"

/* What the time steps do to the answer. */
struct step_error {
    double restitution, impulse;
    double energy_defect; /* |closure| against what is available or approaches */
    bool energy_closes;   /* as the tolerance demands */
    bool unchecked;       /* of a sequence: the effort did not suffice to find it out */
};

/* Solves the attempt's scene again with shorter steps if its error is too large. `modes`: what is
 * known of the attempt already, as longer steps than its own are. PERCUSS_OK, PERCUSS_INTERNAL or
 * PERCUSS_TIMEOUT. */
enum percuss_status step_search(struct attempt_context *context, struct attempt *best,
                                const struct mode_error *modes, struct step_error *error);

#endif
