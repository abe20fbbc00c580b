/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/concurrent.h"

#include <math.h>
#include <string.h>

#include "contact/hertz.h"
#include "impact/contact_step.h"
#include "impact/impact_scale.h"
#include "impact/kernel.h"
#include "impact/march.h"

/* Steps of all contacts, and intervals of a flight: some hundred times as many as needed. */
enum { MAX_STEPS = 100000 };

/* Ratio of dF/dd to F/d of F = k d^(3/2), taken for the region's stiffness. */
static const double HERTZ_POWER = 1.5;

/* A dent less deep than this share of the indentation is the region's rounding. */
static const double ROUNDING = 1e-6;

struct concurrent {
    struct march march;
    unsigned least_steps; /* of a contact */
    struct region *region;
    struct motion end; /* of the current step */
    struct impact_scale scale;
    int level;
    double response;         /* of the approach at a step's end to the force there, m/N, < 0 */
    double depth, earlier;   /* now and a step before, from the bottom of the dent, m */
    double force, stiffness; /* now */
    double peak;             /* N, of the current sub-impact */
    double bottom;           /* of the dent, from the virgin surface, m */
    double work;             /* of the force on the region, J */
};

/* Adds the effect of nodal forces to a state at the step's end. */
static void push(const struct concurrent *run, const double force[NODES], struct motion *end)
{
    double h = step_length(run->level);
    double w = run->march.scene.w[0];
    for (int j = 0; j < NODES; j++) {
        end->gap[0] += w * h * h * collocation.position_end[j] * force[j];
        end->gap_rate[0] += w * h * collocation.weight[j] * force[j];
    }
    for (size_t g = 0; g < run->march.scene.groups; g++) {
        const struct scene_group *group = &run->march.scene.group[g];
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

/* Begins a sub-impact: chooses its step and finds the response to a force. OK, INTERNAL without
 * memory, or TIMEOUT. */
static enum percuss_status begin_contact(struct concurrent *run)
{
    double d;
    double rate;
    double unit[NODES];
    struct march *march = &run->march;
    const struct scene *scene = &march->scene;
    const struct motion *now = &march->outcome->motion;
    /* the step: a share of a contact's duration at this speed, or of the rest of the window */
    motion_approach(now, scene, 0, &d, &rate);
    run->scale = impact_scale_of(march->stated, 0, rate);
    double lasts = fmin(HERTZ_DURATION * run->scale.duration, march->horizon - now->time);
    run->level = step_level(lasts / run->least_steps);
    while (run->level > 0 && now->time + step_length(run->level) == now->time)
        run->level--;
    /* response of bodies at rest to a force that rises to 1 N */
    enum percuss_status status = scene_prepare(scene, run->level, march->pace);
    if (status != PERCUSS_OK)
        return pace_fault(march->fault, status);
    for (size_t g = 0; g < scene->groups; g++) {
        memset(run->end.q[g], 0, scene->group[g].stride * sizeof(double));
        memset(run->end.v[g], 0, scene->group[g].stride * sizeof(double));
    }
    run->end.gap[0] = run->end.gap_rate[0] = 0.0;
    rising(1.0, unit);
    push(run, unit, &run->end);
    motion_approach(&run->end, scene, 0, &run->response, &d);
    run->depth = run->earlier = 0.0;
    run->force = run->stiffness = run->peak = 0.0;
    march_open(march, 0, now->time, now->gap_rate[0]);
    return PERCUSS_OK;
}

/* Moves the end of compression to the vertex of the parabola through the last three depths. */
static void end_compression(const struct concurrent *run, double depth, struct sub_impact *open)
{
    double bend = depth - 2.0 * run->depth + run->earlier;
    double slope = 0.5 * (depth - run->earlier);
    double later = bend < 0.0 ? -slope / bend : 0.0; /* in steps; within a half of one */
    double time = later * step_length(run->level);
    open->max_indentation += 0.5 * later * slope;
    open->compression_end += time;
    open->compression_impulse += time * run->force;
}

/* Records a step: work, impulse, estimates, maxima. */
static void keep_books(struct concurrent *run, double depth, const struct region_answer *answer)
{
    struct track *track = &run->march.outcome->tracks[0];
    struct contact_history *history = &run->march.outcome->laws[0].history;
    double h = step_length(run->level);
    double change = answer->force - run->force;
    double stiffness = depth > 0.0 ? HERTZ_POWER * answer->force / depth : 0.0;
    /* force and depth are lines along the step: work and impulse */
    run->work += 0.5 * (run->force + answer->force) * (depth - run->depth);
    track->open.impulse += 0.5 * h * (run->force + answer->force);
    /* effects of omitted inertia and viscosity, by Hertz' stiffness */
    track->inertia += (stiffness - run->stiffness) * change / h;
    track->viscosity += change * change / h;
    run->stiffness = stiffness;
    /* this sub-impact's largest depth ends its compression */
    if (depth < run->depth && run->depth == track->open.max_indentation)
        end_compression(run, depth, &track->open);
    if (depth > track->open.max_indentation) {
        track->open.max_indentation = depth;
        track->open.compression_end = run->end.time;
        track->open.compression_impulse = track->open.impulse;
    }
    run->peak = fmax(run->peak, answer->force);
    /* the largest depth so far is the history */
    if (run->bottom + depth > history->max_indentation) {
        history->max_indentation = run->bottom + depth;
        history->max_force = answer->force;
        history->contact_radius = answer->radius;
    }
}

/* Ends a sub-impact or the window: the dent deepens to where the surfaces part. */
static enum percuss_status end_contact(struct concurrent *run, double time)
{
    struct march *march = &run->march;
    struct track *track = &march->outcome->tracks[0];
    double bottom;
    enum percuss_status status = region_touch(run->region, &bottom, march->fault);
    if (status != PERCUSS_OK)
        return status;
    march_close(march, 0, time, march->outcome->motion.gap_rate[0]);
    if (track->count <= PERCUSS_MAX_SUB_IMPACTS)
        track->list[track->count - 1].peak_force = run->peak;
    march->outcome->motion.gap[0] += bottom - run->bottom;
    run->bottom = bottom;
    return PERCUSS_OK;
}

/* Solves one step. The force is the sum of a line from the present force to 0 and a line from 0 to
 * the new one. */
static enum percuss_status step(struct concurrent *run, bool *open)
{
    double force[NODES];
    double approach;
    double rate;
    double depth;
    struct region_answer answer;
    struct march *march = &run->march;
    struct motion *now = &march->outcome->motion;
    /* the approach at the end without the new force */
    motion_step(&run->end, now, &march->scene, run->level);
    falling(run->force, force);
    push(run, force, &run->end);
    motion_approach(&run->end, &march->scene, 0, &approach, &rate);
    /* the equilibrium, and the bodies under the new force */
    enum percuss_status status =
        region_approach(run->region, run->bottom + approach,
                        march->scene.residual[0] - run->response, &answer, march->fault);
    if (status != PERCUSS_OK)
        return status;
    depth = answer.indentation - run->bottom;
    region_commit(run->region);
    rising(answer.force, force);
    push(run, force, &run->end);
    /* the damping loss, the records and the new present */
    for (int j = 0; j < NODES; j++)
        force[j] += run->force * (1.0 - collocation.node[j]);
    march->damping += contact_step_loss(&march->scene, now, run->level, &force);
    keep_books(run, depth, &answer);
    struct motion old = *now;
    *now = run->end;
    run->end = old;
    run->earlier = run->depth;
    run->depth = depth;
    run->force = answer.force;
    march->outcome->steps++;
    *open = answer.force == 0.0;
    return PERCUSS_OK;
}

/* Steps from a touch until the contact opens, or to the end. */
static enum percuss_end_reason contact_phase(void *state, size_t contact)
{
    struct concurrent *run = state;
    struct march *march = &run->march;
    const struct motion *now = &march->outcome->motion;
    enum percuss_end_reason end = PERCUSS_END_NONE;
    bool open = false;
    (void)contact;
    /* steps until it is open, or the window or the work ends */
    enum percuss_status status = begin_contact(run);
    while (status == PERCUSS_OK && !open && end == PERCUSS_END_NONE) {
        status = step(run, &open);
        if (march->outcome->steps >= MAX_STEPS)
            end = PERCUSS_END_LIMIT;
        else if (!open && now->time >= march->horizon)
            end = PERCUSS_END_IN_CONTACT;
    }
    /* an opening is placed in the middle of the last step */
    if (status == PERCUSS_OK)
        status = end_contact(run, now->time - (open ? 0.5 * step_length(run->level) : 0.0));
    /* each flight may use all intervals */
    march->used = 0;
    return status == PERCUSS_OK ? end : march_fail(march, status);
}

/* Stores the region's history instead of the law's, and its plastic and residual elastic energy. */
static void end_march(void *state)
{
    struct concurrent *run = state;
    struct impact_outcome *outcome = run->march.outcome;
    struct contact_history *history = &outcome->laws[0].history;
    struct region_ledger ledger;
    history->dent = run->bottom;
    if (!(run->bottom > ROUNDING * history->max_indentation))
        *history = run->march.stated->laws[0].history;
    region_ledger(run->region, &ledger);
    outcome->plastic = ledger.plastic[0] + ledger.plastic[1];
    if (outcome->end_reason != PERCUSS_END_IN_CONTACT && outcome->plastic > 0.0)
        outcome->plastic += ledger.elastic[0] + ledger.elastic[1];
}

enum percuss_status impact_concurrent(const struct scene *scene, struct region *region,
                                      const struct concurrent_settings *settings,
                                      struct arena *arena, struct impact_outcome *outcome,
                                      struct fault *fault)
{
    static const struct march_method method = {.contact_phase = contact_phase, .end = end_march};
    struct concurrent run = {.march = {.stated = scene,
                                       .outcome = outcome,
                                       .horizon = settings->horizon,
                                       .most = MAX_STEPS,
                                       .pace = settings->pace,
                                       .fault = fault},
                             .least_steps = settings->steps,
                             .region = region};
    /* the pace stops the march in the region too */
    region_watch(region, settings->pace, settings->done);
    if (!march_create(&run.march, arena) || !motion_create(&run.end, scene, arena))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = march_run(&run.march, &method, &run, arena);
    if (status == PERCUSS_TIMEOUT && run.march.status == PERCUSS_OK)
        return fault_set(fault, status, "stopped at %g s of the impact", outcome->motion.time);
    if (status != PERCUSS_OK || outcome->end_reason != PERCUSS_END_IN_CONTACT)
        return status;
    /* under load the mesh holds only a part of the elastic energy; the force's work is all */
    double stored = run.work - outcome->plastic + 0.5 * scene->residual[0] * run.force * run.force;
    outcome->energy.stored += stored;
    outcome->energy.closure -= stored;
    return PERCUSS_OK;
}
