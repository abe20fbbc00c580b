/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/march.h"

#include <float.h>
#include <math.h>

#include "impact/energy.h"
#include "impact/rewind.h"
#include "impact/step_cost.h"

bool march_create(struct march *march, struct arena *arena)
{
    const struct scene *scene = march->stated;
    march->scene = *scene;
    march->scene.laws = march->outcome->laws;
    impact_begin(march->outcome, scene);
    motion_start(&march->outcome->motion, scene);
    march->closed = arena_take(arena, scene->contacts, sizeof *march->closed);
    march->indentation = arena_take(arena, scene->contacts, sizeof *march->indentation);
    if (!march->closed || !march->indentation || !flight_create(&march->flight, scene, arena))
        return false;
    march->cost = march->flight.cost = step_cost(scene);
    march->flight.pace = march->pace;
    return true;
}

void march_open(struct march *march, size_t contact, double time, double gap_rate)
{
    march->closed[contact] = true;
    track_open(&march->outcome->tracks[contact], time, gap_rate);
}

void march_close(struct march *march, size_t contact, double time, double gap_rate)
{
    march->closed[contact] = false;
    track_close(&march->outcome->tracks[contact], &march->scene.laws[contact], time, gap_rate);
}

/* Of the impulses, by the sums along their steps, and the coarsest accuracy that is taken for one;
 * of the stated rates, which are differences of bodies' speeds. */
static const double ROUNDING_OF_STEPS = 1e-11;
static const double COARSEST_STEPS = 1e-5;
static const double ROUNDING_OF_SPEEDS = 8.0 * DBL_EPSILON;

double march_unknown_rate(const struct march *march, size_t contact)
{
    const struct scene *scene = march->stated;
    double changed = 0.0;
    double fastest = 0.0;
    for (size_t c = 0; c < scene->contacts; c++) {
        double w = scene->w[contact * scene->contacts + c];
        changed += fabs(w) * march->outcome->tracks[c].impulse;
        double speed = fabs(scene->gap_rate[c]);
        fastest = speed > fastest ? speed : fastest;
    }
    double steps = march->accuracy < ROUNDING_OF_STEPS ? ROUNDING_OF_STEPS
                   : march->accuracy > COARSEST_STEPS  ? COARSEST_STEPS
                                                       : march->accuracy;
    return steps * changed + ROUNDING_OF_SPEEDS * fastest;
}

bool march_in_contact(const struct march *march)
{
    for (size_t c = 0; c < march->scene.contacts; c++)
        if (march->closed[c])
            return true;
    return false;
}

enum percuss_end_reason march_parted(const struct march *march)
{
    for (size_t c = 0; c < march->scene.contacts; c++)
        if (march->scene.gap_acceleration[c] < 0.0)
            return PERCUSS_END_HANDED_BACK;
    return PERCUSS_END_SEPARATED;
}

enum percuss_end_reason march_fail(struct march *march, enum percuss_status status)
{
    march->status = status;
    return PERCUSS_END_LIMIT;
}

static enum percuss_end_reason no_memory(struct march *march)
{
    return march_fail(march, pace_fault(march->fault, PERCUSS_INTERNAL));
}

/* Where bodies overlap at the stated instant, back to their touch. NONE: go on. */
static enum percuss_end_reason find_start(struct march *march, struct arena *arena)
{
    struct impact_outcome *outcome = march->outcome;
    struct rewind rewind = {march->horizon, march->most, arena, march->pace, false};
    enum rewind_end end =
        rewind_to_touch(&rewind, &march->scene, &outcome->motion, &outcome->time_shift);
    outcome->always_overlapped = end == REWIND_NEVER;
    outcome->beyond_horizon = rewind.beyond;
    march->used = march->most - rewind.intervals;
    if (end == REWIND_MEMORY)
        return no_memory(march);
    return end == REWIND_LIMIT ? PERCUSS_END_LIMIT : PERCUSS_END_NONE;
}

/* Free motion to the next touch. NONE: touched. */
static enum percuss_end_reason fly(struct march *march, size_t *contact)
{
    double time = 0.0;
    struct motion *motion = &march->outcome->motion;
    unsigned long before = march->flight.intervals;
    double allowed = march->horizon - motion->time;
    /* the last step of a contact phase may have taken more than was left */
    unsigned long left = march->used < march->most ? march->most - march->used : 0;
    for (size_t c = 0; c < march->scene.contacts; c++)
        march->flight.unknown[c] = march_unknown_rate(march, c);
    enum flight_end end =
        flight_find(&march->flight, &march->scene, motion, allowed, left, &time, contact);
    march->used += march->flight.intervals - before;
    if (end == FLIGHT_MEMORY)
        return no_memory(march);
    if (end == FLIGHT_LIMIT || march->used > march->most)
        return PERCUSS_END_LIMIT;
    /* what damping takes on the way, and the motion at its end */
    march->damping += motion_free_loss(motion, &march->scene, time);
    motion_copy(motion, &march->flight.probe, &march->scene);
    if (end == FLIGHT_TIMEOUT)
        return PERCUSS_END_HORIZON;
    return end == FLIGHT_COMPLETE ? march_parted(march) : PERCUSS_END_NONE;
}

/* Start of the first sub-impact of all, 0 when there is none. */
static double first_touch(const struct march *march)
{
    double first = INFINITY;
    for (size_t c = 0; c < march->scene.contacts; c++)
        if (march->outcome->tracks[c].count)
            first = fmin(first, march->outcome->tracks[c].list[0].start);
    return isfinite(first) ? first : 0.0;
}

/* The window ends: the books are closed and the energy is audited. */
static enum percuss_status finish(struct march *march, struct arena *arena)
{
    struct impact_outcome *outcome = march->outcome;
    const struct motion *motion = &outcome->motion;
    for (size_t c = 0; c < march->scene.contacts; c++) {
        if (march->closed[c])
            march_close(march, c, motion->time, motion->gap_rate[c]);
        track_mark_negligible(&outcome->tracks[c]);
    }
    outcome->window = motion->time;
    outcome->effort = march->used;
    if (outcome->time_shift == 0.0)
        outcome->time_shift = first_touch(march);
    if (!energy_audit(march->stated, march->indentation, march->damping, arena, outcome))
        return pace_fault(march->fault, PERCUSS_INTERNAL);
    return pace_status(march->pace);
}

enum percuss_status march_run(struct march *march, const struct march_method *method, void *state,
                              struct arena *arena)
{
    size_t contact = 0;
    /* back to where bodies that overlap have touched */
    enum percuss_end_reason end = find_start(march, arena);
    if (march->outcome->always_overlapped)
        return PERCUSS_OK;
    /* flights and contact phases in turn */
    while (end == PERCUSS_END_NONE) {
        if (!method->flies)
            end = fly(march, &contact);
        if (end == PERCUSS_END_NONE)
            end = method->contact_phase(state, contact);
    }
    /* the method's own end, then the books */
    if (march->status != PERCUSS_OK)
        return march->status;
    march->outcome->end_reason = end;
    method->end(state);
    return finish(march, arena);
}
