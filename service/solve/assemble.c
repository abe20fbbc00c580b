/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/assemble.h"

#include <math.h>
#include <string.h>

#include "impact/oscillator.h"

/* A group whose shapes all vanish at every contact, up to rounding, does not exist for the scene.
 */
static const double NODE_SHARE = 1e-9;

/* What one family of one body adds. */
struct addition {
    struct assembly *assembly;
    const struct geometry *geometry;
    const struct body_state *state;
    double elapsed;
    size_t body;
    enum mode_family family;
    const struct prepared_family *prepared;
    size_t count; /* modes of the family that take part */
    struct arena *arena;
};

/* The load of contact c on a body, with the family's part in it, or NULL. */
static const struct site_load *load_on(const struct geometry *geometry, size_t contact, size_t body,
                                       enum mode_family family)
{
    for (int which = 0; which < 2; which++) {
        const struct contact_side *side = &geometry->sides[contact][which];
        if (side->body == body && side->load.acts[family])
            return &side->load;
    }
    return NULL;
}

static bool family_is_loaded(const struct geometry *geometry, size_t body, enum mode_family family)
{
    for (size_t c = 0; c < geometry->contact_count; c++)
        if (load_on(geometry, c, body, family))
            return true;
    return false;
}

/* Number of modes up to `cut`, found by asking for more until they exceed it. */
static size_t count_below(struct prepared_cache *cache, const struct body *body,
                          enum mode_family family, double cut)
{
    for (size_t ask = 8;; ask *= 2) {
        if (ask > ASSEMBLE_MAX_MODES)
            ask = ASSEMBLE_MAX_MODES;
        const struct prepared_family *prepared = prepared_family_get(cache, body, family, ask);
        if (!prepared)
            return ASSEMBLE_MAX_MODES + 1;
        /* never more than asked for, whatever the cache holds already: same request, same answer */
        size_t count = 0;
        while (count < ask && prepared->modes->rank[count] <= cut)
            count++;
        if (count < ask || ask == ASSEMBLE_MAX_MODES)
            return count;
    }
}

/* Initial coordinates of the group's modes: the state, `elapsed` later. */
static bool set_initial(const struct addition *add, struct scene_group *group,
                        const struct prepared_group *source)
{
    if (!add->state || add->state->count[add->family] == 0)
        return true;
    const double *pairs = body_state_family(add->state, (int)add->family);
    double *q = arena_take(add->arena, group->stride, sizeof *q);
    double *v = arena_take(add->arena, group->stride, sizeof *v);
    if (!q || !v)
        return false;
    for (size_t k = 0; k < group->count; k++) {
        size_t mode = source->mode[k];
        if (mode >= add->state->count[add->family])
            continue;
        q[k] = pairs[2 * mode];
        v[k] = pairs[2 * mode + 1];
        oscillator_advance(group->set->omega[k], group->set->damping, add->elapsed, &q[k], &v[k]);
    }
    group->q = q;
    group->v = v;
    return true;
}

/* Fills one row of participations; returns its largest magnitude. */
static double fill_row(const struct addition *add, const struct prepared_group *source,
                       const struct site_load *load, size_t count, double *row)
{
    const struct body *body = add->geometry->bodies[add->body];
    double largest = 0.0;
    for (size_t k = 0; k < count; k++) {
        row[k] = modal_participation(body, add->prepared->modes, source->mode[k], load);
        largest = fmax(largest, fabs(row[k]));
    }
    return largest;
}

/* A mode of unit mass distribution has participations of about 1/sqrt(mass). */
static double participation_scale(const struct body *body)
{
    return 1.0 / sqrt(body->mass);
}

/* The group if a contact excites it; *added tells. */
static bool add_group(const struct addition *add, const struct prepared_group *source, bool *added)
{
    struct assembly *assembly = add->assembly;
    size_t n = add->geometry->contact_count;
    struct scene_group *group = &assembly->groups[assembly->scene.groups];
    *group = (struct scene_group){.set = source->set, .body = add->body};
    while (group->count < source->set->count && source->mode[group->count] < add->count)
        group->count++;
    group->stride = (group->count + LANES - 1) / LANES * LANES;
    group->participation = arena_take(add->arena, n, sizeof *group->participation);
    if (!group->participation)
        return false;
    double scale = participation_scale(add->geometry->bodies[add->body]);
    *added = false;
    for (size_t c = 0; c < n && group->count; c++) {
        const struct site_load *load = load_on(add->geometry, c, add->body, add->family);
        if (!load)
            continue;
        double *row = arena_take(add->arena, group->stride, sizeof *row);
        if (!row)
            return false;
        if (fill_row(add, source, load, group->count, row) <= NODE_SHARE * scale)
            continue;
        group->participation[c] = row;
        *added = true;
    }
    return !*added || set_initial(add, group, source);
}

/* What the modal sum already holds of the compliance between two contacts. */
static double held_compliance(const struct scene_group *group, size_t i, size_t j)
{
    const double *a = group->participation[i];
    const double *b = group->participation[j];
    double sum = 0.0;
    /* small terms first: the residual is a small difference */
    for (size_t k = group->count; a && b && k-- > 0;)
        sum += a[k] * b[k] / (group->set->omega[k] * group->set->omega[k]);
    return sum;
}

static bool add_family(const struct addition *add, double *residual)
{
    struct assembly *assembly = add->assembly;
    const struct geometry *geometry = add->geometry;
    const struct body *body = geometry->bodies[add->body];
    size_t n = geometry->contact_count;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            const struct site_load *a = load_on(geometry, i, add->body, add->family);
            const struct site_load *b = load_on(geometry, j, add->body, add->family);
            if (a && b)
                residual[i * n + j] += modal_compliance(body, add->family, a, b);
        }
    }
    for (size_t g = 0; g < add->prepared->group_count; g++) {
        bool added;
        if (!add_group(add, &add->prepared->groups[g], &added))
            return false;
        if (!added)
            continue;
        struct scene_group *group = &assembly->groups[assembly->scene.groups];
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                residual[i * n + j] -= held_compliance(group, i, j);
        assembly->sources[assembly->scene.groups] = &add->prepared->groups[g];
        assembly->families[assembly->scene.groups] = add->family;
        assembly->scene.groups++;
        assembly->modes[add->body] += group->count;
        assembly->all_modes += group->count;
        assembly->highest = fmax(assembly->highest, group->set->omega[group->count - 1]);
    }
    if (body->modes == 0 && add->count < add->prepared->modes->count) {
        double omitted = add->prepared->modes->rank[add->count];
        assembly->lowest_omitted = fmin(assembly->lowest_omitted, omitted);
        assembly->omitted[add->body] = fmin(assembly->omitted[add->body], omitted);
    }
    return true;
}

static bool fill_scene(struct assembly *assembly, const struct geometry *geometry,
                       const struct solve_request *request, struct arena *arena)
{
    size_t n = geometry->contact_count;
    double *gap = arena_take(arena, n, sizeof *gap);
    double *acceleration = arena_take(arena, n, sizeof *acceleration);
    struct contact_law *laws = arena_take(arena, n, sizeof *laws);
    if (!gap || !acceleration || !laws)
        return false;
    for (size_t c = 0; c < n; c++) {
        gap[c] = request->contacts[c].gap;
        acceleration[c] = request->contacts[c].gap_acceleration;
        laws[c] = contact_law_hertz(geometry->hertz[c].stiffness);
    }
    assembly->scene.contacts = n;
    assembly->scene.bodies = geometry->body_count;
    assembly->scene.w = geometry->w;
    assembly->scene.gap = gap;
    assembly->scene.gap_rate = geometry->gap_rate;
    assembly->scene.gap_acceleration = acceleration;
    assembly->scene.laws = laws;
    assembly->scene.group = assembly->groups;
    return true;
}

/* How many modes of the family take part. */
static size_t wanted(struct prepared_cache *cache, const struct body *body, enum mode_family family,
                     const struct body_state *state, const struct assemble_choice *choice)
{
    size_t count = body->modes ? (size_t)(body->modes * choice->fixed_share)
                               : count_below(cache, body, family, choice->cut);
    if (state && state->count[family] > count)
        count = state->count[family];
    return count;
}

bool assemble(struct assembly *assembly, const struct geometry *geometry,
              const struct solve_request *request, struct prepared_cache *cache,
              const struct assemble_choice *choice, struct arena *arena)
{
    size_t n = geometry->contact_count;
    double *residual = arena_take(arena, n * n, sizeof *residual);
    memset(assembly->modes, 0, sizeof assembly->modes);
    assembly->scene = (struct scene){.residual = residual};
    for (size_t b = 0; b < PERCUSS_MAX_BODIES; b++)
        assembly->omitted[b] = INFINITY;
    assembly->all_modes = 0;
    assembly->capped = false;
    assembly->highest = 0.0;
    assembly->lowest_omitted = INFINITY;
    if (!residual || !fill_scene(assembly, geometry, request, arena))
        return false;
    for (size_t b = 0; b < geometry->body_count; b++) {
        const struct body *body = geometry->bodies[b];
        for (int f = 0; f < FAMILY_COUNT && body_is_flexible(body); f++) {
            struct addition add = {.assembly = assembly,
                                   .geometry = geometry,
                                   .state = request->bodies[b].state,
                                   .elapsed = request->bodies[b].elapsed,
                                   .body = b,
                                   .family = (enum mode_family)f,
                                   .arena = arena};
            if (!family_is_loaded(geometry, b, add.family))
                continue;
            add.count = wanted(cache, body, add.family, add.state, choice);
            if (add.count > ASSEMBLE_MAX_MODES)
                return false;
            assembly->capped = assembly->capped || add.count == ASSEMBLE_MAX_MODES;
            add.prepared = prepared_family_get(cache, body, add.family, add.count + 1);
            if (!add.prepared || !add_family(&add, residual))
                return false;
        }
    }
    return true;
}
