/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The vibration of a body at one instant: what a state token names. */
#ifndef PERCUSS_SOLVE_BODY_STATE_H
#define PERCUSS_SOLVE_BODY_STATE_H

#include <stddef.h>

#include "model/modal_basis.h"

/* Immutable. `coordinates` holds count[f] pairs (q, dq/dt), family after family, mass-normalised
 * modes in the body frame, lowest first. One block of memory, free() releases it. */
struct body_state {
    size_t count[FAMILY_COUNT];
    double coordinates[];
};

/* Number of bytes of a state. */
static inline size_t body_state_size(const struct body_state *state)
{
    size_t pairs = 0;
    for (int family = 0; family < FAMILY_COUNT; family++)
        pairs += state->count[family];
    return sizeof *state + 2 * pairs * sizeof *state->coordinates;
}

/* The pairs of one family. */
static inline const double *body_state_family(const struct body_state *state, int family)
{
    size_t before = 0;
    for (int f = 0; f < family; f++)
        before += state->count[f];
    return state->coordinates + 2 * before;
}

#endif
