/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/concurrent.h"

#include <math.h>
#include <string.h>

#include "impact/contact_step.h"
#include "impact/energy.h"
#include "impact/flight.h"
#include "impact/impact_scale.h"
#include "impact/kernel.h"
#include "impact/rewind.h"
#include "impact/step_cost.h"

enum { MAX_PRESSES = 40, MAX_STEPS = 100000 };

/* Largest last change of an indentation over the contact's: the force follows it on its tangent, so
 * that what remains is of second order. */
static const double SETTLED = 1e-4;

/* A contact lasts this many times its scale (Hertz, rigid bodies). */
static const double HERTZ_DURATION = 2.94;

struct concurrent {
    const struct scene *scene;
    const struct concurrent_settings *settings;
    struct region *region;
    struct impact_outcome *outcome;
    struct motion *motion; /* the outcome's: the present */
    struct motion end;     /* of the step under way */
    struct flight flight;
    struct impact_scale scale;
    int level;
    double response;         /* of the approach at a step's end to the force there, m/N, < 0 */
    double depth[3];         /* now and at the two steps before, from the bottom of the dent, m */
    double force, stiffness; /* now */
    double peak;             /* N, of the sub-impact under way */
    double bottom;           /* of the dent, from the virgin surface, m */
    double work;             /* of the force on the region, J */
    double damping;          /* J */
    struct fault *fault;
};

/* What forces at the nodes do to a state at the end of the step. */
static void push(const struct concurrent *run, const double force[NODES], struct motion *end)
{
    double h = step_length(run->level);
    double w = run->scene->w[0];
    for (int j = 0; j < NODES; j++) {
        end->gap[0] += w * h * h * collocation.position_end[j] * force[j];
        end->gap_rate[0] += w * h * collocation.weight[j] * force[j];
    }
    for (size_t g = 0; g < run->scene->groups; g++) {
        const struct scene_group *group = &run->scene->group[g];
        if (group->participation[0])
            kernel_push(group->set->tables[run->level], group->stride, group->participation[0],
                        force, end->q[g], end->v[g]);
    }
}

/* A force that falls from `from` to 0, or rises from 0 to `to`, along the step. */
static void falling(double from, double force[NODES])
{
    for (int j = 0; j < NODES; j++)
        force[j] = from * (1.0 - collocation.node[j]);
}

static void rising(double to, double force[NODES])
{
    for (int j = 0; j < NODES; j++)
        force[j] = to * collocation.node[j];
}

/* The step's end if nothing pushed. */
static void fly_step(struct concurrent *run)
{
    const struct scene *scene = run->scene;
    double h = step_length(run->level);
    double a = scene->gap_acceleration[0];
    run->end.time = run->motion->time + h;
    run->end.gap[0] = run->motion->gap[0] + h * (run->motion->gap_rate[0] + 0.5 * a * h);
    run->end.gap_rate[0] = run->motion->gap_rate[0] + a * h;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        kernel_advance(group->set->tables[run->level], group->stride, run->motion->q[g],
                       run->motion->v[g], run->end.q[g], run->end.v[g]);
    }
}

/* A sub-impact begins: its step, and what a force does within one. False: out of memory. */
static bool begin_contact(struct concurrent *run)
{
    double d;
    double rate;
    double unit[NODES];
    const struct scene *scene = run->scene;
    motion_approach(run->motion, scene, 0, &d, &rate);
    run->scale = impact_scale_of(scene, 0, rate);
    run->level = step_level(HERTZ_DURATION * run->scale.duration / run->settings->steps);
    for (size_t g = 0; g < scene->groups; g++) {
        if (!oscillators_table(scene->group[g].set, run->level))
            return false;
        memset(run->end.q[g], 0, scene->group[g].stride * sizeof(double));
        memset(run->end.v[g], 0, scene->group[g].stride * sizeof(double));
    }
    run->end.gap[0] = run->end.gap_rate[0] = 0.0;
    rising(1.0, unit);
    push(run, unit, &run->end);
    motion_approach(&run->end, scene, 0, &run->response, &d);
    double h = step_length(run->level);
    for (int i = 0; i < 3; i++)
        run->depth[i] = -i * rate * h;
    run->force = run->stiffness = run->peak = 0.0;
    track_open(&run->outcome->tracks[0], run->motion->time, run->motion->gap_rate[0]);
    return true;
}

/* Depth and force at the end of a step: depth + compliance force(depth) = approach. The left side
 * rises with the depth; where its slope jumps (nodes that touch) Newton's method is kept between
 * the bounds found so far. */
static enum percuss_status find_depth(struct concurrent *run, double approach,
                                      struct region_answer *answer, double *depth)
{
    double compliance = run->scene->residual[0] - run->response;
    double low = -INFINITY;
    double high = INFINITY;
    *depth = 3.0 * (run->depth[0] - run->depth[1]) + run->depth[2];
    for (int i = 0; i < MAX_PRESSES; i++) {
        enum percuss_status status =
            region_press(run->region, run->bottom + *depth, answer, run->fault);
        if (status != PERCUSS_OK)
            return status;
        double excess = *depth + compliance * answer->force - approach;
        double change = -excess / (1.0 + compliance * answer->stiffness);
        if (fabs(change) <= SETTLED * run->scale.indentation) {
            *depth += change;
            answer->force = fmax(0.0, answer->force + answer->stiffness * change);
            return PERCUSS_OK;
        }
        *(excess > 0.0 ? &high : &low) = *depth;
        double next = *depth + change;
        *depth = next > low && next < high ? next : 0.5 * (low + high);
    }
    return fault_set(run->fault, PERCUSS_INTERNAL,
                     "concurrent finite elements: no equilibrium at %g s", run->motion->time);
}

/* The books of the step from the present to its end. */
static void keep_books(struct concurrent *run, double depth, const struct region_answer *answer)
{
    struct track *track = &run->outcome->tracks[0];
    struct contact_history *history = &run->outcome->laws[0].history;
    double h = step_length(run->level);
    double change = answer->force - run->force;
    double stiffness = depth > 0.0 ? 1.5 * answer->force / depth : 0.0;
    run->work += 0.5 * (run->force + answer->force) * (depth - run->depth[0]);
    track->open.impulse += 0.5 * h * (run->force + answer->force);
    track->inertia += (stiffness - run->stiffness) * change / h;
    track->viscosity += change * change / h;
    run->stiffness = stiffness;
    if (depth > track->open.max_indentation) {
        track->open.max_indentation = depth;
        track->open.compression_end = run->end.time;
        track->open.compression_impulse = track->open.impulse;
    }
    run->peak = fmax(run->peak, answer->force);
    if (run->bottom + depth > history->max_indentation) {
        history->max_indentation = run->bottom + depth;
        history->max_force = answer->force;
        history->contact_radius = answer->radius;
    }
}

/* The contact is open again, or the window ends: the dent deepens to where the surfaces part. */
static enum percuss_status end_contact(struct concurrent *run, double time)
{
    struct track *track = &run->outcome->tracks[0];
    double bottom;
    enum percuss_status status = region_touch(run->region, &bottom, run->fault);
    if (status != PERCUSS_OK)
        return status;
    track_close(track, &run->outcome->laws[0], time, run->motion->gap_rate[0]);
    if (track->count <= PERCUSS_MAX_SUB_IMPACTS)
        track->list[track->count - 1].peak_force = run->peak;
    run->motion->gap[0] += bottom - run->bottom;
    run->bottom = bottom;
    return PERCUSS_OK;
}

static enum percuss_status step(struct concurrent *run, bool *open)
{
    double force[NODES];
    double approach;
    double rate;
    double depth;
    struct region_answer answer;
    fly_step(run);
    falling(run->force, force);
    push(run, force, &run->end);
    motion_approach(&run->end, run->scene, 0, &approach, &rate);
    enum percuss_status status = find_depth(run, approach, &answer, &depth);
    if (status != PERCUSS_OK)
        return status;
    region_commit(run->region);
    rising(answer.force, force);
    push(run, force, &run->end);
    for (int j = 0; j < NODES; j++)
        force[j] += run->force * (1.0 - collocation.node[j]);
    run->damping += contact_step_loss(run->scene, run->motion, run->level, &force);
    keep_books(run, depth, &answer);
    struct motion old = *run->motion;
    *run->motion = run->end;
    run->end = old;
    run->depth[2] = run->depth[1];
    run->depth[1] = run->depth[0];
    run->depth[0] = depth;
    run->force = answer.force;
    run->outcome->steps++;
    *open = answer.force == 0.0;
    return PERCUSS_OK;
}

/* From a touch until the contact is open again, or the end. */
static enum percuss_status contact_phase(struct concurrent *run, enum percuss_end_reason *end)
{
    const struct concurrent_settings *settings = run->settings;
    bool open = false;
    if (!begin_contact(run))
        return fault_set(run->fault, PERCUSS_INTERNAL, "out of memory");
    while (!open && *end == PERCUSS_END_NONE) {
        enum percuss_status status = step(run, &open);
        if (status != PERCUSS_OK)
            return status;
        if (run->outcome->steps >= MAX_STEPS)
            *end = PERCUSS_END_LIMIT;
        else if (!open && run->motion->time >= settings->horizon)
            *end = PERCUSS_END_IN_CONTACT;
    }
    /* the force fell to nothing within the last step, and nearly all of it before */
    return end_contact(run, run->motion->time - (open ? 0.5 * step_length(run->level) : 0.0));
}

/* Free motion to the next touch (NONE), or the end. */
static enum percuss_end_reason fly(struct concurrent *run)
{
    double time = 0.0;
    size_t contact;
    double allowed = run->settings->horizon - run->motion->time;
    enum flight_end end =
        flight_find(&run->flight, run->scene, run->motion, allowed, MAX_STEPS, &time, &contact);
    if (end == FLIGHT_LIMIT || end == FLIGHT_MEMORY)
        return PERCUSS_END_LIMIT;
    run->damping += motion_free_loss(run->motion, run->scene, time);
    motion_advance(run->motion, run->scene, time);
    if (end == FLIGHT_TIMEOUT)
        return PERCUSS_END_HORIZON;
    if (end == FLIGHT_COMPLETE)
        return run->scene->gap_acceleration[0] < 0.0 ? PERCUSS_END_HANDED_BACK
                                                     : PERCUSS_END_SEPARATED;
    return PERCUSS_END_NONE;
}

/* Each term by itself: flow and residual stresses from the region's own ledger. */
static bool audit(struct concurrent *run, struct arena *arena)
{
    struct impact_outcome *outcome = run->outcome;
    struct region_ledger ledger;
    double none = 0.0;
    bool closed = outcome->end_reason == PERCUSS_END_IN_CONTACT;
    region_ledger(run->region, &ledger);
    outcome->plastic = ledger.plastic[0] + ledger.plastic[1];
    if (!closed && outcome->plastic > 0.0)
        outcome->plastic += ledger.elastic[0] + ledger.elastic[1];
    if (!energy_audit(run->scene, &none, run->damping, arena, outcome))
        return false;
    /* under load the mesh holds a part of the elastic energy only: what the force has put in */
    double stored = closed ? run->work - outcome->plastic +
                                 0.5 * run->scene->residual[0] * run->force * run->force
                           : 0.0;
    outcome->energy.stored += stored;
    outcome->energy.closure -= stored;
    return true;
}

static bool run_create(struct concurrent *run, struct arena *arena)
{
    return motion_create(&run->end, run->scene, arena) &&
           flight_create(&run->flight, run->scene, arena);
}

enum percuss_status impact_concurrent(const struct scene *scene, struct region *region,
                                      const struct concurrent_settings *settings,
                                      struct arena *arena, struct impact_outcome *outcome,
                                      struct fault *fault)
{
    struct concurrent run = {.scene = scene,
                             .settings = settings,
                             .region = region,
                             .outcome = outcome,
                             .motion = &outcome->motion,
                             .fault = fault};
    enum percuss_end_reason end = PERCUSS_END_NONE;
    enum percuss_status status = PERCUSS_OK;
    impact_begin(outcome, scene);
    region_watch(region, settings->pace, settings->done);
    outcome->steps = outcome->rejected = 0;
    if (!run_create(&run, arena))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    run.flight.pace = settings->pace;
    run.flight.cost = step_cost(scene);
    motion_start(run.motion, scene);
    struct rewind rewind = {settings->horizon, MAX_STEPS, arena, settings->pace, false};
    enum rewind_end start = rewind_to_touch(&rewind, scene, run.motion, &outcome->time_shift);
    outcome->always_overlapped = start == REWIND_NEVER;
    outcome->beyond_horizon = rewind.beyond;
    if (outcome->always_overlapped)
        return PERCUSS_OK;
    if (start == REWIND_LIMIT || start == REWIND_MEMORY)
        return fault_set(fault, pace_status(settings->pace) ? PERCUSS_TIMEOUT : PERCUSS_INTERNAL,
                         "the way back to the touch was not found in time");
    while (status == PERCUSS_OK && (end = fly(&run)) == PERCUSS_END_NONE) {
        if (outcome->steps == 0 && outcome->time_shift == 0.0)
            outcome->time_shift = run.motion->time;
        status = contact_phase(&run, &end);
        if (end != PERCUSS_END_NONE)
            break;
    }
    if (status != PERCUSS_OK)
        return status;
    if (pace_status(settings->pace))
        return fault_set(fault, PERCUSS_TIMEOUT, "stopped at %g s of the impact", run.motion->time);
    track_mark_negligible(&outcome->tracks[0]);
    outcome->end_reason = end;
    outcome->window = run.motion->time;
    outcome->intervals = run.flight.intervals;
    outcome->laws[0].history.residual = run.bottom;
    /* rounding is no dent */
    if (!(run.bottom > 1e-6 * outcome->laws[0].history.max_indentation))
        outcome->laws[0].history = scene->laws[0].history;
    return audit(&run, arena) ? PERCUSS_OK : PERCUSS_INTERNAL;
}
