/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* State of a body, which a state token names: its vibration at one instant and the dents in its
 * surface. */
#ifndef PERCUSS_CONTACT_BODY_STATE_H
#define PERCUSS_CONTACT_BODY_STATE_H

#include <stddef.h>

#include "base/arena.h"
#include "contact/law.h"
#include "model/bending_axes.h"

/* A patch of the surface that yielded; it affects contacts within `size` of its middle. */
struct dent {
    double point[3]; /* body frame, m */
    double size;     /* contact radius at the largest force, m */
    struct contact_history history;
};

/* Most dents that a state holds; the shallowest are dropped. */
enum { BODY_STATE_MAX_DENTS = 256 };

/* Immutable. `coordinates` holds count[f] pairs (q, dq/dt), family after family, mass-normalised
 * modes in the body frame, lowest first; the dents follow. One block of memory, free() releases it.
 */
struct body_state {
    size_t count[BODY_MOST_FAMILIES];
    size_t dents;
    /* relative errors of the amplitudes: by modes and steps of the answers that left them, and by
     * their models; 0: not known */
    double unknown, unknown_model;
    /* modes from known[f] of a family on were omitted in one of those answers, but excited: to a
     * speed of phi abruptness omega^(-5/2) (solve/error/state.c), N/s^(3/2) */
    double abruptness;
    size_t known[BODY_MOST_FAMILIES];
    double coordinates[];
};

/* Number of pairs of the families below one. */
static inline size_t body_state_pairs(const struct body_state *state, size_t family)
{
    size_t pairs = 0;
    for (size_t f = 0; f < family; f++)
        pairs += state->count[f];
    return pairs;
}

/* Number of bytes of a state. */
static inline size_t body_state_size(const struct body_state *state)
{
    return sizeof *state +
           2 * body_state_pairs(state, BODY_MOST_FAMILIES) * sizeof *state->coordinates +
           state->dents * sizeof(struct dent);
}

/* The pairs of one family. */
static inline const double *body_state_family(const struct body_state *state, size_t family)
{
    return state->coordinates + 2 * body_state_pairs(state, family);
}

/* The dents: all their members are doubles. */
static inline const struct dent *body_state_dents(const struct body_state *state)
{
    return (const struct dent *)body_state_family(state, BODY_MOST_FAMILIES);
}

/* Enlarges the sizes of a state for its rotation by principal axes: equal in both bending families.
 */
void body_state_make_room(const struct bending_axes *axes, struct body_state *sizes);

/* A copy with the modes in the planes of the axes, from the arena; dents stay. NULL: no memory. */
const struct body_state *body_state_turned(const struct body_state *state,
                                           const struct bending_axes *axes, struct arena *arena);

/* Turns a state of such sizes back into the body's own planes. */
void body_state_turn_back(const struct bending_axes *axes, struct body_state *state);

#endif
