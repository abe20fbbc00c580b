/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <string.h>

#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/energy.h"
#include "impact/flight.h"
#include "impact/impact.h"
#include "impact/rewind.h"
#include "impact/step_cost.h"
#include "impact/step_limits.h"
#include "impact/yielding.h"

/* A run of the modal method. */
struct modal_run {
    const struct scene *scene;
    const struct impact_settings *settings;
    struct impact_outcome *outcome;
    struct motion *motion; /* the outcome's: the current state */
    struct step_limits limits;
    struct contact_step step;
    struct flight flight;
    struct yielding yielding;
    bool *active;   /* [contact] */
    bool *everyone; /* [contact] true: all contacts are in the equations of a contact phase */
    struct contact_start *now;     /* [contact], local */
    double *final;                 /* [contact], indentation at the end of the window */
    struct impact_scale *scales;   /* [contact], of the sub-impact under way */
    double *longest;               /* [contact], stable step, s */
    double damping;                /* J taken so far */
    double roughness;              /* largest highest-order share of a force on an accepted step */
    unsigned long used, max_steps; /* contact steps and flight intervals */
    double step_cost;              /* of each of them */
};

static bool any_active(const struct modal_run *run)
{
    for (size_t c = 0; c < run->scene->contacts; c++)
        if (run->active[c])
            return true;
    return false;
}

/* Laws have yielded: what follows has the scale of their branches, which are shorter, stiffest at
 * the top and hold less energy: the speed goes with its root. */
static void rescale(struct modal_run *run)
{
    for (size_t c = 0; c < run->scene->contacts; c++) {
        struct impact_scale *scale = &run->scales[c];
        double span = contact_law_limit(&run->scene->laws[c]);
        double force = run->scene->laws[c].history.max_force;
        if (!run->active[c] || !(force > 0.0) || !(span < scale->indentation))
            continue;
        double slower = sqrt(force * span / (scale->force * scale->indentation));
        scale->duration *= span / (scale->indentation * slower);
        scale->indentation = span;
        scale->force = force;
        run->longest[c] = step_limits_stable(run->scene, c, scale, run->limits.coupling);
    }
}

/* Laws have yielded. False: one has begun an unloading that its series compliance does not bear. */
static bool unload(struct modal_run *run)
{
    rescale(run);
    for (size_t c = 0; c < run->scene->contacts; c++)
        if (!contact_bears(run->scene, c, contact_law_unloading(&run->scene->laws[c])))
            run->outcome->too_stiff = true;
    return !run->outcome->too_stiff;
}

/* A sub-impact begins at `time` with an approach rate. */
static void activate(struct modal_run *run, size_t contact, double time, double rate)
{
    run->active[contact] = true;
    run->scales[contact] = impact_scale_of(run->scene, contact, rate);
    run->longest[contact] =
        step_limits_stable(run->scene, contact, &run->scales[contact], run->limits.coupling);
    track_open(&run->outcome->tracks[contact], time, run->motion->gap_rate[contact]);
}

/* It ends at `time`; the motion may be a little later. */
static void deactivate(struct modal_run *run, size_t contact, double time)
{
    run->active[contact] = false;
    double late = run->motion->time - time;
    track_close(&run->outcome->tracks[contact], &run->scene->laws[contact], time,
                run->motion->gap_rate[contact] - run->scene->gap_acceleration[contact] * late);
}

/* The finest level that events and grading need. */
static int finest_level(const struct modal_run *run)
{
    /* a contact that opens without speed has no duration of its own */
    double shortest = 0.01 * run->settings->horizon;
    for (size_t c = 0; c < run->scene->contacts; c++)
        if (run->active[c])
            shortest = fmin(shortest, run->scales[c].duration);
    return step_level(shortest * run->limits.event_share);
}

/* A step must not jump over a contact's end (at most three quarters of the way there), nor pump a
 * mode, nor pass the horizon. */
static int limit_level(const struct modal_run *run, int level, int finest)
{
    for (size_t c = 0; c < run->scene->contacts; c++) {
        if (!run->active[c])
            continue;
        double left = run->longest[c];
        if (run->now[c].rate < 0.0)
            left = fmin(left, 0.75 * run->now[c].indentation / -run->now[c].rate);
        while (level < finest && step_length(level) > left)
            level++;
    }
    double remaining = run->settings->horizon - run->motion->time;
    while (level < STEP_LEVELS - 1 && step_length(level) > remaining)
        level++;
    return level;
}

/* Force against which a contact's roughness counts: its scale, or what it bears already. A contact
 * that opens without speed in a group has no scale of its own: a hundredth of the group's will do.
 */
static double force_scale(const struct modal_run *run, size_t contact)
{
    double own = run->scales[contact].force;
    double group = 0.0;
    for (int j = 0; j < NODES; j++)
        own = fmax(own, run->step.force[contact][j]);
    for (size_t c = 0; c < run->scene->contacts; c++)
        if (run->active[c])
            group = fmax(group, run->scales[c].force);
    return fmax(own, 0.01 * group);
}

/* How much of the contacts' forces the highest coefficient of the step's cubic is. In a group a
 * contact may close after the last node: there the cubic misses the force at the end. */
static double step_roughness(const struct modal_run *run)
{
    double worst = 0.0;
    size_t contacts = run->scene->contacts;
    for (size_t c = 0; c < contacts; c++) {
        const double *force = run->step.force[c];
        double highest = 0.0;
        for (int j = 0; j < NODES; j++)
            highest += collocation.highest[j] * force[j];
        double off = contacts > 1 ? run->step.end_force[c] - collocation_value(force, 1.0) : 0.0;
        worst = fmax(worst, fmax(fabs(highest), fabs(off)) / force_scale(run, c));
    }
    return worst;
}

/* The only closed contact ends inside the step: the step is cut there, as its force has no
 * derivative there. While several are closed they open and close all the time, mostly with little
 * force: all of them are in the equations throughout, and roughness alone decides. */
static bool has_event(const struct modal_run *run)
{
    size_t closed = 0;
    bool ends = false;
    for (size_t c = 0; c < run->scene->contacts; c++) {
        closed += run->active[c];
        ends = ends || (run->active[c] && !(run->step.end_indentation[c] > 0.0));
    }
    return closed == 1 && ends;
}

/* Last instant with positive indentation on the step just made: linear between the nodes around it.
 */
static double release_time(const struct modal_run *run, size_t contact, double start, double h)
{
    double s[NODES + 2];
    double d[NODES + 2];
    s[0] = 0.0;
    d[0] = run->now[contact].indentation;
    for (int j = 0; j < NODES; j++) {
        s[j + 1] = collocation.node[j];
        d[j + 1] = run->step.indentation[contact][j];
    }
    s[NODES + 1] = 1.0;
    d[NODES + 1] = run->step.end_indentation[contact];
    int last = NODES;
    while (last > 0 && d[last] <= 0.0)
        last--;
    double share = d[last] > 0.0 ? d[last] / (d[last] - d[last + 1]) : 0.0;
    return start + h * (s[last] + share * (s[last + 1] - s[last]));
}

/* Local values at the end of the step: derivatives of the cubic through its nodes. */
static struct contact_start end_values(const double values[NODES], double h, double indentation)
{
    double rate = 0.0;
    double curvature = 0.0;
    double bend = 0.0;
    for (int j = 0; j < NODES; j++) {
        const double *c = collocation.monomial[j];
        rate += values[j] * (c[1] + 2.0 * c[2] + 3.0 * c[3]);
        curvature += values[j] * (2.0 * c[2] + 6.0 * c[3]);
        bend += values[j] * 6.0 * c[3];
    }
    double r = 1.0 / h;
    return (struct contact_start){indentation, rate * r, curvature * (r * r), bend * (r * r * r)};
}

/* First instant with positive indentation on the step just made, likewise. */
static double closing_time(const struct modal_run *run, size_t contact, double start, double h)
{
    double before = run->now[contact].indentation;
    double at = 0.0;
    for (int j = 0; j <= NODES; j++) {
        double s = j < NODES ? collocation.node[j] : 1.0;
        double d =
            j < NODES ? run->step.indentation[contact][j] : run->step.end_indentation[contact];
        if (d > 0.0)
            return start + h * (at + (s - at) * fmax(0.0, -before) / (d + fmax(0.0, -before)));
        before = d;
        at = s;
    }
    return start + h;
}

/* Whether a contact bears a force at any node of the step. */
static bool bears(const struct modal_run *run, size_t contact)
{
    for (int j = 0; j < NODES; j++)
        if (run->step.force[contact][j] > 0.0)
            return true;
    return false;
}

/* The books of one contact after a step: sub-impacts begin, go on, end (also all of it within one
 * step of a group). */
static void keep_books(struct modal_run *run, size_t c, double start, double h)
{
    double end = run->step.end_indentation[c];
    struct track_values values = {run->now[c].indentation, end, run->step.indentation[c],
                                  run->step.force[c], run->step.stiffness[c]};
    struct contact_start after = end_values(run->step.indentation[c], h, end);
    if (!run->active[c] && (end > 0.0 || bears(run, c)))
        activate(run, c, closing_time(run, c, start, h), fmax(run->now[c].rate, after.rate));
    if (run->active[c]) {
        track_step(&run->outcome->tracks[c], start, h, &values);
        if (end <= 0.0)
            deactivate(run, c, release_time(run, c, start, h));
    }
    run->now[c] = after;
}

/* Makes the step just solved the present. */
static void accept(struct modal_run *run, int level)
{
    double start = run->motion->time;
    struct motion old = *run->motion;
    if (run->settings->log)
        force_log_add(run->settings->log, start, level, run->step.force, run->step.indentation);
    *run->motion = run->step.end;
    run->step.end = old;
    run->damping += run->step.loss;
    run->outcome->steps++;
    for (size_t c = 0; c < run->scene->contacts; c++)
        keep_books(run, c, start, step_length(level));
}

/* Starting values of the contacts that are open while another one is closed. */
static void begin_phase(struct modal_run *run)
{
    for (size_t c = 0; c < run->scene->contacts; c++) {
        double d;
        double rate;
        if (run->active[c])
            continue;
        motion_approach(run->motion, run->scene, c, &d, &rate);
        run->now[c] = (struct contact_start){fmin(d, 0.0), rate, 0.0, 0.0};
    }
}

/* From the first touch until every contact is open again, the horizon, or the limit. */
static enum percuss_end_reason contact_phase(struct modal_run *run)
{
    double allowed = run->limits.roughness;
    int level = finest_level(run);
    begin_phase(run);
    while (any_active(run)) {
        if (++run->used > run->max_steps || !pace_keeps(run->settings->pace, run->step_cost))
            return PERCUSS_END_LIMIT;
        int finest = finest_level(run);
        /* roughness may ask for more than events do: a graze is shorter than its scale */
        int deepest = finest + 8;
        level = limit_level(run, level < deepest ? level : deepest, finest);
        if (run->yielding.any)
            level = yielding_level(&run->yielding, level);
        double h = step_length(level);
        if (run->motion->time + h == run->motion->time ||
            run->settings->horizon - run->motion->time < step_length(finest))
            return PERCUSS_END_IN_CONTACT;
        unsigned long before = run->step.iterations;
        bool solved =
            contact_step_solve(&run->step, run->scene, run->motion, run->everyone, level, run->now);
        /* a step takes two or three iterations; one that does not converge costs as much as ten */
        run->used += (run->step.iterations - before) / 8;
        double roughness = solved ? step_roughness(run) : INFINITY;
        bool fine = level >= finest;
        if (!solved || (!fine && (roughness > 3.0 * allowed || has_event(run)))) {
            /* a step is not shortened any further: again the same would be tried */
            if (level >= (solved ? STEP_LEVELS - 1 : deepest))
                return PERCUSS_END_LIMIT;
            run->outcome->rejected++;
            level++;
            continue;
        }
        if (run->yielding.any && yielding_passes(&run->yielding, h, &level)) {
            if (!unload(run))
                return PERCUSS_END_LIMIT;
            run->outcome->rejected++;
            continue;
        }
        accept(run, level);
        run->roughness = fmax(run->roughness, roughness);
        /* the coefficient falls with the third power of the step */
        if (roughness < allowed / 8.0 && level > 0)
            level--;
        else if (roughness > allowed)
            level++;
        if (run->yielding.any && yielding_meet(&run->yielding, h, &level) && !unload(run))
            return PERCUSS_END_LIMIT;
    }
    return PERCUSS_END_NONE;
}

/* Free motion to the next touch. NONE: touched. */
static enum percuss_end_reason fly(struct modal_run *run)
{
    double time = 0.0;
    size_t contact = 0;
    unsigned long before = run->flight.intervals;
    double allowed = run->settings->horizon - run->motion->time;
    /* the last step of a contact phase may have taken more than was left */
    unsigned long left = run->used < run->max_steps ? run->max_steps - run->used : 0;
    enum flight_end end =
        flight_find(&run->flight, run->scene, run->motion, allowed, left, &time, &contact);
    run->used += run->flight.intervals - before;
    if ((end == FLIGHT_LIMIT || end == FLIGHT_MEMORY) || run->used > run->max_steps)
        return PERCUSS_END_LIMIT;
    run->damping += motion_free_loss(run->motion, run->scene, time);
    motion_advance(run->motion, run->scene, time);
    if (end == FLIGHT_TIMEOUT)
        return PERCUSS_END_HORIZON;
    if (end == FLIGHT_COMPLETE) {
        for (size_t c = 0; c < run->scene->contacts; c++)
            if (run->scene->gap_acceleration[c] < 0.0)
                return PERCUSS_END_HANDED_BACK;
        return PERCUSS_END_SEPARATED;
    }
    double d;
    double rate;
    motion_approach(run->motion, run->scene, contact, &d, &rate);
    activate(run, contact, run->motion->time, rate);
    run->now[contact] = (struct contact_start){0.0, rate, 0.0, 0.0};
    return PERCUSS_END_NONE;
}

static bool run_create(struct modal_run *run, const struct scene *scene, struct arena *arena)
{
    run->active = arena_take(arena, scene->contacts, sizeof *run->active);
    run->everyone = arena_take(arena, scene->contacts, sizeof *run->everyone);
    for (size_t c = 0; run->everyone && c < scene->contacts; c++)
        run->everyone[c] = true;
    run->now = arena_take(arena, scene->contacts, sizeof *run->now);
    run->final = arena_take(arena, scene->contacts, sizeof *run->final);
    run->scales = arena_take(arena, scene->contacts, sizeof *run->scales);
    run->longest = arena_take(arena, scene->contacts, sizeof *run->longest);
    run->yielding = (struct yielding){.scene = scene,
                                      .outcome = run->outcome,
                                      .step = &run->step,
                                      .now = run->now,
                                      .active = run->active,
                                      .scales = run->scales,
                                      .accuracy = run->settings->accuracy};
    return run->active && run->everyone && run->now && run->final && run->scales && run->longest &&
           contact_step_create(&run->step, scene, arena) &&
           flight_create(&run->flight, scene, arena) && yielding_create(&run->yielding, arena);
}

enum percuss_status impact_modal(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome)
{
    /* the laws change as they yield: the outcome's own */
    struct scene own = *scene;
    struct modal_run run = {.scene = &own, .settings = settings, .outcome = outcome};
    own.laws = outcome->laws;
    run.motion = &outcome->motion;
    impact_begin(outcome, scene);
    run.limits = step_limits_make(settings->accuracy);
    if (!run_create(&run, &own, arena))
        return PERCUSS_INTERNAL;
    run.step.accuracy = settings->accuracy;
    outcome->steps = outcome->rejected = 0;
    motion_start(run.motion, scene);
    run.max_steps = impact_max_steps(scene, settings);
    run.step_cost = run.flight.cost = step_cost(scene);
    run.flight.pace = run.step.pace = settings->pace;
    struct rewind rewind = {settings->horizon, run.max_steps, arena, settings->pace, false};
    enum rewind_end start = rewind_to_touch(&rewind, scene, run.motion, &outcome->time_shift);
    outcome->always_overlapped = start == REWIND_NEVER;
    outcome->beyond_horizon = rewind.beyond;
    if (outcome->always_overlapped)
        return PERCUSS_OK;
    run.used = run.max_steps - rewind.intervals;
    bool touched = false;
    enum percuss_end_reason end =
        (start == REWIND_LIMIT || start == REWIND_MEMORY) ? PERCUSS_END_LIMIT : PERCUSS_END_NONE;
    while (end == PERCUSS_END_NONE) {
        end = fly(&run);
        if (end != PERCUSS_END_NONE)
            break;
        if (!touched && outcome->time_shift == 0.0)
            outcome->time_shift = run.motion->time;
        touched = true;
        end = contact_phase(&run);
    }
    yielding_end(&run.yielding);
    for (size_t c = 0; c < scene->contacts; c++) {
        run.final[c] = run.active[c] ? run.now[c].indentation : 0.0;
        if (run.active[c])
            deactivate(&run, c, run.motion->time);
        track_mark_negligible(&outcome->tracks[c]);
    }
    outcome->end_reason = end;
    outcome->window = run.motion->time;
    outcome->intervals = run.flight.intervals;
    outcome->effort = run.used;
    return energy_audit(scene, run.final, run.damping, arena, outcome) ? pace_status(settings->pace)
                                                                       : PERCUSS_INTERNAL;
}
