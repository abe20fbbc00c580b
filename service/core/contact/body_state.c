/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/body_state.h"

#include <string.h>

void body_state_make_room(const struct bending_axes *axes, struct body_state *sizes)
{
    size_t *y = &sizes->count[axes->first];
    size_t *z = y + 1;
    if (axes->sine != 0.0)
        *y = *z = *y > *z ? *y : *z;
    /* modes that one family does not know are unknown in both */
    y = &sizes->known[axes->first];
    z = y + 1;
    if (axes->sine != 0.0)
        *y = *z = *y < *z ? *y : *z;
}

static void turn_planes(const struct bending_axes *axes, struct body_state *state)
{
    double *y = (double *)body_state_family(state, axes->first);
    double *z = (double *)body_state_family(state, axes->first + 1);
    bending_axes_turn(axes, 2 * state->count[axes->first], y, z);
}

const struct body_state *body_state_turned(const struct body_state *state,
                                           const struct bending_axes *axes, struct arena *arena)
{
    struct body_state sizes = *state;
    body_state_make_room(axes, &sizes);
    struct body_state *turned = arena_take(arena, 1, body_state_size(&sizes));
    if (!turned)
        return NULL;
    *turned = sizes;
    for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
        memcpy((double *)body_state_family(turned, f), body_state_family(state, f),
               2 * state->count[f] * sizeof *state->coordinates);
    memcpy((struct dent *)body_state_dents(turned), body_state_dents(state),
           state->dents * sizeof(struct dent));
    turn_planes(axes, turned);
    return turned;
}

void body_state_turn_back(const struct bending_axes *axes, struct body_state *state)
{
    const struct bending_axes back = {axes->first, axes->cosine, -axes->sine};
    if (axes->sine != 0.0)
        turn_planes(&back, state);
}
