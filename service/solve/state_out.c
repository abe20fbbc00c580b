/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/state_out.h"

#include <string.h>

#include "impact/oscillator.h"

/* How many modes of a family the new state holds. */
static size_t family_size(const struct assembly *assembly, const struct body_state *before,
                          size_t body, int family)
{
    size_t size = before ? before->count[family] : 0;
    for (size_t g = 0; g < assembly->scene.groups; g++) {
        const struct scene_group *group = &assembly->groups[g];
        if (group->body != body || assembly->families[g] != (enum mode_family)family)
            continue;
        size_t last = assembly->sources[g]->mode[group->count - 1] + 1;
        size = last > size ? last : size;
    }
    return size;
}

/* Frequencies of modes that took no part are asked of the body anew. */
static void move_freely(const struct body *body, enum mode_family family,
                        const struct body_state *before, double time, double *pairs)
{
    size_t count = before->count[family];
    struct modal_family *modes = modal_family_create(body, family, count);
    memcpy(pairs, body_state_family(before, (int)family), 2 * count * sizeof *pairs);
    for (size_t k = 0; modes && k < count; k++)
        oscillator_advance(modes->omega[k], body->damping, time, &pairs[2 * k], &pairs[2 * k + 1]);
    modal_family_free(modes);
}

const struct body_state *state_after(const struct assembly *assembly,
                                     const struct impact_outcome *outcome,
                                     const struct geometry *geometry,
                                     const struct solve_body *stated, size_t body,
                                     struct arena *arena)
{
    if (!body_is_flexible(geometry->bodies[body]))
        return NULL;
    struct body_state sizes = {{0}};
    size_t pairs = 0;
    for (int f = 0; f < FAMILY_COUNT; f++) {
        sizes.count[f] = family_size(assembly, stated->state, body, f);
        pairs += sizes.count[f];
    }
    struct body_state *state = arena_take(arena, 1, sizeof sizes + 2 * pairs * sizeof(double));
    if (!state)
        return NULL;
    memcpy(state->count, sizes.count, sizeof state->count);
    for (int f = 0; f < FAMILY_COUNT; f++) {
        double *family = (double *)body_state_family(state, f);
        if (stated->state && stated->state->count[f])
            move_freely(geometry->bodies[body], (enum mode_family)f, stated->state,
                        stated->elapsed + outcome->window, family);
        for (size_t g = 0; g < assembly->scene.groups; g++) {
            const struct scene_group *group = &assembly->groups[g];
            if (group->body != body || assembly->families[g] != (enum mode_family)f)
                continue;
            for (size_t k = 0; k < group->count; k++) {
                size_t mode = assembly->sources[g]->mode[k];
                family[2 * mode] = outcome->motion.q[g][k];
                family[2 * mode + 1] = outcome->motion.v[g][k];
            }
        }
    }
    return state;
}
