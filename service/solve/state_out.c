/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/state_out.h"

#include <math.h>
#include <string.h>

#include "impact/oscillator.h"
#include "model/damping.h"
#include "solve/contact_model.h"

/* How many modes of a family the new state holds. */
static size_t family_size(const struct assembly *assembly, const struct body_state *before,
                          size_t body, size_t family)
{
    size_t size = before ? before->count[family] : 0;
    for (size_t g = 0; g < assembly->scene.groups; g++) {
        const struct scene_group *group = &assembly->groups[g];
        if (group->body != body || assembly->families[g] != family)
            continue;
        size_t last = assembly->sources[g]->mode[group->count - 1] + 1;
        size = last > size ? last : size;
    }
    return size;
}

/* A solution's free motions, s: from the state to the stated instant, back to a touch before it (0:
 * it lies after it), and on from there. */
struct free_times {
    double elapsed, back, on;
};

/* As those move that take part: nothing is damped on the way back, see motion_rewind. */
static void move_one(double omega, double damping, const struct free_times *times, double pair[2])
{
    if (times->back == 0.0) {
        oscillator_advance(omega, damping, times->elapsed + times->on, &pair[0], &pair[1]);
        return;
    }
    oscillator_advance(omega, damping, times->elapsed, &pair[0], &pair[1]);
    oscillator_advance(omega, 0.0, times->back, &pair[0], &pair[1]);
    oscillator_advance(omega, damping, times->on, &pair[0], &pair[1]);
}

/* Frequencies of modes that took no part are asked of the body anew. */
static void move_freely(const struct body *body, size_t family, const struct body_state *before,
                        const struct free_times *times, struct arena *arena, double *pairs)
{
    size_t count = before->count[family];
    struct modal_family *modes = modal_family_create(body, family, count);
    arena->lacks = arena->lacks || !modes;
    memcpy(pairs, body_state_family(before, family), 2 * count * sizeof *pairs);
    for (size_t k = 0; modes && k < count && k < modes->count; k++)
        move_one(modes->omega[k], damping_of(body, k), times, pairs + 2 * k);
    modal_family_free(modes);
}

static void fill_modes(const struct assembly *assembly, const struct impact_outcome *outcome,
                       const struct problem *problem, double elapsed, struct body_state *state,
                       size_t index)
{
    const struct body *body = problem->bodies[index];
    const struct body_state *before = problem->states[index];
    double back = fmin(outcome->time_shift, 0.0);
    const struct free_times times = {elapsed, back, outcome->window - back};
    for (size_t f = 0; f < body->kind->family_count; f++) {
        double *family = (double *)body_state_family(state, f);
        /* modes that took no part vibrate on freely */
        if (before && before->count[f])
            move_freely(body, f, before, &times, problem->arena, family);
        /* the others are as the impact left them */
        for (size_t g = 0; g < assembly->scene.groups; g++) {
            const struct scene_group *group = &assembly->groups[g];
            if (group->body != index || assembly->families[g] != f)
                continue;
            for (size_t k = 0; k < group->count; k++) {
                size_t mode = assembly->sources[g]->mode[k];
                family[2 * mode] = outcome->motion.q[g][k];
                family[2 * mode + 1] = outcome->motion.v[g][k];
            }
        }
    }
}

/* A place for one more dent: the next one, or that of the shallowest. */
static struct dent *new_dent(struct dent *dents, size_t *count)
{
    if (*count < BODY_STATE_MAX_DENTS)
        return &dents[(*count)++];
    struct dent *shallowest = dents;
    for (size_t i = 1; i < *count; i++)
        if (dents[i].history.dent < shallowest->history.dent)
            shallowest = &dents[i];
    return shallowest;
}

/* The dents of a body after the impact; their number. */
static size_t find_dents(const struct impact_outcome *outcome, const struct problem *problem,
                         const struct body_state *before, size_t body, struct dent *dents)
{
    size_t count = before ? before->dents : 0;
    if (count)
        memcpy(dents, body_state_dents(before), count * sizeof *dents);
    for (size_t c = 0; c < problem->contact_count; c++) {
        const struct contact_choice *choice = &problem->contact_model.choices[c];
        if (choice->side < 0 || problem->sides[c][choice->side].body != body ||
            !contact_model_yielded(problem, outcome, c))
            continue;
        struct dent *dent = choice->dented ? &dents[choice->dent] : new_dent(dents, &count);
        dent->history = outcome->laws[c].history;
        dent->size = dent->history.contact_radius;
        if (!choice->dented)
            memcpy(dent->point, problem->sides[c][choice->side].site.point, sizeof dent->point);
    }
    return count;
}

const struct body_state *state_after(const struct assembly *assembly,
                                     const struct impact_outcome *outcome,
                                     const struct problem *problem, size_t body)
{
    bool flexible = body_is_flexible(problem->bodies[body]);
    const struct solve_body *stated = &problem->request->bodies[body];
    /* how much there is to keep */
    struct dent dents[BODY_STATE_MAX_DENTS];
    struct body_state sizes = {.dents = 0};
    if (problem->request->options.dents == PERCUSS_DENTS_KEEP)
        sizes.dents = find_dents(outcome, problem, stated->state, body, dents);
    if (!flexible && !sizes.dents)
        return NULL;
    for (size_t f = 0; f < problem->bodies[body]->kind->family_count; f++)
        sizes.count[f] = family_size(assembly, problem->states[body], body, f);
    /* one block of it */
    body_state_make_room(&problem->axes[body], &sizes);
    struct body_state *state = arena_take(problem->arena, 1, body_state_size(&sizes));
    if (!state)
        return NULL;
    *state = sizes;
    /* filled */
    if (flexible) {
        fill_modes(assembly, outcome, problem, stated->elapsed, state, body);
        body_state_turn_back(&problem->axes[body], state);
    }
    if (sizes.dents)
        memcpy((struct dent *)body_state_dents(state), dents, sizes.dents * sizeof *dents);
    return state;
}
