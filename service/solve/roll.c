/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/roll.h"

#include <math.h>
#include <string.h>

static const struct roll UPRIGHT = {1.0, 0.0};
/* Planes closer to the body's own than this (rad) are those: rounding of the pose. */
static const double NEGLIGIBLE = 1e-9;

static bool is_upright(const struct roll *roll)
{
    return roll->sine == 0.0;
}

/* The plane (y, z) of a force on the side, or of the moment of one beside the axis of an end. */
static void plane_of(const struct site_load *load, double plane[2])
{
    double force = hypot(load->bending[0].force, load->bending[1].force);
    double moment = hypot(load->bending[0].moment, load->bending[1].moment);
    for (int i = 0; i < 2; i++)
        plane[i] = moment > 0.0 && load->axial != 0.0 ? load->bending[i].moment / moment
                                                      : load->bending[i].force / force;
}

/* The scene's z goes through the first load that bends the body. */
static struct roll choose(const struct problem *problem, size_t body)
{
    if (!modal_planes_alike(problem->bodies[body]))
        return UPRIGHT;
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const struct contact_side *side = &problem->sides[c][which];
            const bool *acts = side->load.acts;
            double plane[2];
            if (side->body != body || !(acts[FAMILY_BENDING_Y] || acts[FAMILY_BENDING_Z]))
                continue;
            plane_of(&side->load, plane);
            if (fabs(plane[0]) <= NEGLIGIBLE)
                return UPRIGHT;
            double sign = plane[1] < 0.0 ? -1.0 : 1.0;
            return (struct roll){sign * plane[1], sign * plane[0]};
        }
    return UPRIGHT;
}

void roll_size(const struct roll *roll, struct body_state *sizes)
{
    size_t *y = &sizes->count[FAMILY_BENDING_Y];
    size_t *z = &sizes->count[FAMILY_BENDING_Z];
    if (!is_upright(roll))
        *y = *z = *y > *z ? *y : *z;
}

/* (y, z) of every mode times the rotation; both planes have as many modes as the longer one. */
static void turn(const struct roll *roll, const struct body_state *state, struct body_state *turned)
{
    size_t count[2] = {state->count[FAMILY_BENDING_Y], state->count[FAMILY_BENDING_Z]};
    const double *y = body_state_family(state, FAMILY_BENDING_Y);
    const double *z = body_state_family(state, FAMILY_BENDING_Z);
    double *turned_y = (double *)body_state_family(turned, FAMILY_BENDING_Y);
    double *turned_z = (double *)body_state_family(turned, FAMILY_BENDING_Z);
    for (size_t i = 0; i < 2 * turned->count[FAMILY_BENDING_Z]; i++) {
        double along_y = i < 2 * count[0] ? y[i] : 0.0;
        double along_z = i < 2 * count[1] ? z[i] : 0.0;
        turned_y[i] = roll->cosine * along_y - roll->sine * along_z;
        turned_z[i] = roll->cosine * along_z + roll->sine * along_y;
    }
}

/* The families that do not bend, and the dents, stay. NULL: out of memory. */
static const struct body_state *turned_copy(const struct roll *roll, const struct body_state *state,
                                            struct arena *arena)
{
    struct body_state sizes = *state;
    roll_size(roll, &sizes);
    struct body_state *turned = arena_take(arena, 1, body_state_size(&sizes));
    if (!turned)
        return NULL;
    *turned = sizes;
    for (int f = 0; f < FAMILY_COUNT; f++)
        if (state->count[f] == sizes.count[f])
            memcpy((double *)body_state_family(turned, f), body_state_family(state, f),
                   2 * sizes.count[f] * sizeof *state->coordinates);
    memcpy((struct dent *)body_state_dents(turned), body_state_dents(state),
           state->dents * sizeof(struct dent));
    turn(roll, state, turned);
    return turned;
}

static void turn_loads(struct problem *problem, size_t body, const struct roll *roll)
{
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            struct contact_side *side = &problem->sides[c][which];
            if (side->body == body)
                site_load_turn(problem->bodies[body], roll->cosine, roll->sine, &side->load);
        }
}

bool roll_choose(struct problem *problem)
{
    for (size_t b = 0; b < problem->body_count; b++) {
        const struct body_state *state = problem->request->bodies[b].state;
        struct roll *roll = &problem->rolls[b];
        *roll = choose(problem, b);
        problem->states[b] = state;
        if (is_upright(roll))
            continue;
        turn_loads(problem, b, roll);
        if (state)
            problem->states[b] = turned_copy(roll, state, problem->arena);
        if (state && !problem->states[b])
            return false;
    }
    return true;
}

void roll_back(const struct roll *roll, struct body_state *state)
{
    const struct roll back = {roll->cosine, -roll->sine};
    if (!is_upright(roll))
        turn(&back, state, state);
}
