/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/memory_rates.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"

void memory_rates_create(struct memory_rates *rates, const struct contact_law *law,
                         double compliance)
{
    *rates = (struct memory_rates){.modes = recovery_modes_make(law->table),
                                   .stiffness = law->parameters[0],
                                   .compliance = compliance};
    contact_memory_begin(&rates->memory, law->table, &rates->modes);
}

enum { PARTS = 4 }; /* center, total, slope, bend */

size_t memory_rates_size(const struct memory_rates *rates)
{
    return PARTS * rates->modes.count;
}

void memory_rates_tolerate(const struct memory_rates *rates, double relative, double indentation,
                           double *absolute)
{
    size_t n = rates->modes.count;
    for (size_t i = 0; i < n; i++) {
        absolute[i] = relative * indentation;
        absolute[n + i] = relative * indentation * sqrt(indentation);
        absolute[2 * n + i] = relative;
        absolute[3 * n + i] = relative / indentation;
    }
}

/* The memory of a state at a time. */
static struct contact_memory unpack(const struct memory_rates *rates, const double *state,
                                    double time)
{
    struct contact_memory memory = rates->memory;
    size_t n = rates->modes.count;
    double *const parts[PARTS] = {memory.center, memory.total, memory.slope, memory.bend};
    for (size_t p = 0; p < PARTS; p++)
        memcpy(parts[p], state + p * n, n * sizeof *state);
    recovery_fade(&memory.left, &rates->modes, time - rates->time);
    return memory;
}

static void pack(const struct memory_rates *rates, double *state)
{
    size_t n = rates->modes.count;
    const struct contact_memory *memory = &rates->memory;
    const double *const parts[PARTS] = {memory->center, memory->total, memory->slope, memory->bend};
    for (size_t p = 0; p < PARTS; p++)
        memcpy(state + p * n, parts[p], n * sizeof *state);
}

/* The part of the surface's displacement that does not follow d, as a parabola of y: while it grows
 * what is left, u0, while it shrinks all that is remembered; and the rate at which that changes. */
struct surface {
    double shape[3], rate[3];
};

static struct surface find_left(const struct memory_rates *rates,
                                const struct contact_memory *memory)
{
    struct surface surface = {{0.0}, {0.0}};
    double kept[RELAXATION_MOST], fading[RELAXATION_MOST];
    if (!(memory->left.reach > 0.0))
        return surface;
    for (size_t l = 0; l < rates->modes.count; l++) {
        kept[l] = 1.0;
        fading[l] = -1.0 / rates->modes.time[l];
    }
    recovery_shape(&memory->left, &rates->modes, kept, surface.shape);
    recovery_shape(&memory->left, &rates->modes, fading, surface.rate);
    return surface;
}

/* Of all terms under an indentation. */
static struct surface find_remembered(const struct contact_memory *memory, double d)
{
    struct surface surface = {{0.0}, {0.0}};
    for (size_t i = 0; i < memory->relaxation->count; i++) {
        const double part[3] = {memory->center[i], memory->slope[i], memory->bend[i]};
        const double to[3] = {d, -1.0, 0.0};
        for (int p = 0; p < 3; p++) {
            double share = memory->relaxation->share[i];
            surface.shape[p] += share * part[p];
            surface.rate[p] += share * (to[p] - part[p]) / memory->relaxation->time[i];
        }
    }
    return surface;
}

/* Of a contact at an indentation. */
struct force {
    double force, slope; /* N, N/m */
    double raised;       /* G, while it grows */
    double edge;         /* width that bears, or would, m */
    double pressed;      /* m */
    struct surface surface;
};

static struct force find_force(const struct memory_rates *rates,
                               const struct contact_memory *memory, double d)
{
    double k = rates->stiffness;
    struct force now = {.surface = memory->shrinks ? find_remembered(memory, d)
                                                   : find_left(rates, memory)};
    const double *shape = now.surface.shape;
    const double pressed[3] = {d - shape[0], -1.0 - shape[1], -shape[2]};
    double width = memory->shrinks ? memory->width : memory->left.reach;
    now.pressed = pressed[0];
    now.edge = contact_memory_edge(d, pressed, width);
    if (memory->shrinks) {
        now.force = contact_memory_shrinking(k, d, pressed, width, &now.slope);
        return now;
    }
    double remembered = 0.0, rise, slope;
    for (size_t i = 0; i < memory->relaxation->count; i++)
        remembered += memory->relaxation->share[i] * memory->total[i];
    now.raised = contact_memory_shrinking(1.0, d, pressed, width, &rise);
    now.force = contact_memory_growing(k, now.raised, remembered, &slope);
    now.slope = slope * rise;
    return now;
}

/* Newton's method for d + c F(d) = approach. */
enum { MOST_ROUNDS = 40 };
static const double SAME = 1e-15;

static struct force solve(const struct memory_rates *rates, const struct contact_memory *memory,
                          struct memory_instant *at)
{
    struct force now = {0};
    for (int round = 0; round < MOST_ROUNDS; round++) {
        now = find_force(rates, memory, at->indentation);
        double excess = at->indentation + rates->compliance * now.force - at->approach;
        if (fabs(excess) <= SAME * fabs(at->approach))
            break;
        at->indentation -= excess / (1.0 + rates->compliance * now.slope);
    }
    return now;
}

static void find_rates(const struct contact_memory *memory, const struct force *now, double k,
                       double d, double *rate)
{
    size_t n = memory->relaxation->count;
    double all = 0.0;
    for (size_t i = 0; i < n; i++)
        all += memory->relaxation->share[i] * memory->total[i];
    double middle = memory->shrinks ? d : larger(now->pressed, 0.0);
    double total = memory->shrinks ? now->force / k + all : now->raised;
    for (size_t i = 0; i < n; i++) {
        double faster = 1.0 / memory->relaxation->time[i];
        rate[i] = faster * (middle - memory->center[i]);
        rate[n + i] = faster * (total - memory->total[i]);
        rate[2 * n + i] = memory->shrinks ? faster * (-1.0 - memory->slope[i]) : 0.0;
        rate[3 * n + i] = memory->shrinks ? -faster * memory->bend[i] : 0.0;
    }
}

void memory_rates_find(const struct memory_rates *rates, const double *state,
                       struct memory_instant *at, double *rate)
{
    const struct contact_memory memory = unpack(rates, state, at->time);
    const struct force now = solve(rates, &memory, at);
    double k = rates->stiffness, d = at->indentation, edge = larger(now.edge, 0.0);
    const double *moves = now.surface.rate;
    find_rates(&memory, &now, k, d, rate);
    at->force = now.force;
    at->stiffness = now.slope;
    at->pressed = now.pressed;
    at->fades = at->recedes = 0.0;
    if (now.force > 0.0) {
        double width = memory.shrinks ? memory.width : memory.left.reach, y = smaller(edge, width);
        at->fades = -1.5 * k * sqrt(y) * (moves[0] + y * (moves[1] / 3.0 + y * moves[2] / 5.0));
        for (size_t i = 0; !memory.shrinks && i < rates->modes.count; i++)
            at->fades -= k * memory.relaxation->share[i] * rate[rates->modes.count + i];
    }
    if (!memory.shrinks && edge <= memory.left.reach)
        at->recedes = moves[0] + edge * (moves[1] + edge * moves[2]);
}

void memory_rates_meet(struct memory_rates *rates, double *state, const struct memory_instant *at)
{
    struct contact_memory *memory = &rates->memory;
    *memory = unpack(rates, state, at->time);
    rates->time = at->time;
    double edge = find_force(rates, memory, at->indentation).edge;
    if (memory->shrinks) {
        recovery_modes_split(&rates->modes, memory->total, memory->left.total);
        contact_memory_renew(memory);
    } else if (edge > 0.0 && at->pressed > 0.0) {
        contact_memory_shrink(memory, edge);
    }
    pack(rates, state);
}
