/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The vibration of a body at one instant and the dents in its surface: what a state token names. */
#ifndef PERCUSS_CONTACT_BODY_STATE_H
#define PERCUSS_CONTACT_BODY_STATE_H

#include <stddef.h>

#include "base/arena.h"
#include "contact/law.h"
#include "model/roll.h"

/* A patch of the surface that yielded: contacts within `size` of its middle feel it. */
struct dent {
    double point[3]; /* body frame, m */
    double size;     /* contact radius at the largest force, m */
    struct contact_history history;
};

/* Most dents that a state holds; the shallowest make place. */
enum { BODY_STATE_MAX_DENTS = 256 };

/* Immutable. `coordinates` holds count[f] pairs (q, dq/dt), family after family, mass-normalised
 * modes in the body frame, lowest first; the dents follow. One block of memory, free() releases it.
 */
struct body_state {
    size_t count[BODY_MOST_FAMILIES];
    size_t dents;
    /* what the amplitudes may be wrong by, as shares of them: by modes and steps of the answers
     * that left them, and by their models; 0: nothing is known of it */
    double unknown, unknown_model;
    /* modes that took no part in one of those answers, from known[f] of a family on, were struck
     * all the same: to a speed of phi abruptness omega^(-5/2) (start_error.c), N/s^(3/2) */
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

/* What sizes a state needs for the turn of a roll: as many modes in either family. */
void body_state_make_room(const struct roll *roll, struct body_state *sizes);

/* A copy whose modes are those of the roll; dents stay. From the arena; NULL: out of memory. */
const struct body_state *body_state_turned(const struct body_state *state, const struct roll *roll,
                                           struct arena *arena);

/* Turns a state with room for it back into the body's own planes. */
void body_state_turn_back(const struct roll *roll, struct body_state *state);

#endif
