/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The modal method: in a contact phase the forces at four Gauss nodes of a step are the only
 * unknowns, and the modes follow them exactly. */
#include <math.h>

#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/march.h"
#include "impact/step_ends.h"
#include "impact/step_knots.h"
#include "impact/step_limits.h"
#include "impact/step_values.h"
#include "impact/yielding.h"

struct modal_run {
    struct march march;
    const struct impact_settings *settings;
    struct step_limits limits;
    struct contact_step step;
    struct yielding yielding;
    struct contact_start *now;   /* [contact], local */
    struct impact_scale *scales; /* [contact], of the sub-impact under way */
    double *longest;             /* [contact], stable step, s */
    bool projects;               /* forces where contacts begin and end, step_ends.h */
    int finest;                  /* level that events and grading of the closed contacts need */
};

/* A contact that opens without speed has no duration of its own: its shortest step is that of a
 * contact as long as this share of the horizon. */
static const double SLOWEST_SHARE = 0.01;

/* A step goes at most this share of the way to where a contact would open as it moves now. */
static const double SHARE_TO_OPENING = 0.85;

/* A contact that opens without speed in a group has no scale of its own: its roughness counts
 * against this share of the group's force. */
static const double SHARE_OF_GROUP = 0.01;

/* Half a step has an eighth of the roughness, whose coefficient falls with the third power. A step
 * is thrown away from nearly the geometric middle of the two on: the next are shorter anyway. */
static const double LONGER_ROUGHER = 8.0;
static const double TOO_ROUGH = 3.0;

enum {
    /* Roughness may ask for more than events do, as a graze is shorter than its scale: by 2^11. */
    GRAZE_LEVELS = 11,
    /* A step takes two or three iterations; so many more cost as much as one more. */
    ITERATIONS_PER_STEP = 8
};

/* fmax and fmin are calls; these are for numbers. */
static double larger(double a, double b)
{
    return a > b ? a : b;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* The contacts that are closed, or their scales, have changed. */
static void find_finest(struct modal_run *run)
{
    double shortest = SLOWEST_SHARE * run->march.horizon;
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        if (run->march.closed[c])
            shortest = smaller(shortest, run->scales[c].duration);
    run->finest = step_level(shortest * run->limits.event_share);
}

/* Laws have yielded: what follows has the scale of their branches, which are shorter, stiffest at
 * the top and hold less energy: the speed goes with its root. */
static void rescale(struct modal_run *run)
{
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        struct impact_scale *scale = &run->scales[c];
        double span = contact_law_limit(&run->march.scene.laws[c]);
        double force = run->march.scene.laws[c].history.max_force;
        if (!run->march.closed[c] || !(force > 0.0) || !(span < scale->indentation))
            continue;
        double slower = sqrt(force * span / (scale->force * scale->indentation));
        scale->duration *= span / (scale->indentation * slower);
        scale->indentation = span;
        scale->force = force;
        run->longest[c] = step_limits_stable(&run->march.scene, c, scale, run->limits.coupling);
    }
    find_finest(run);
}

/* Laws have yielded. False: one has begun an unloading that its series compliance does not bear. */
static bool unload(struct modal_run *run)
{
    rescale(run);
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        if (!contact_bears(&run->march.scene, c, contact_law_unloading(&run->march.scene.laws[c])))
            run->march.outcome->too_stiff = true;
    return !run->march.outcome->too_stiff;
}

/* A sub-impact of a contact begins at `time` with an approach rate. */
static void open_contact(struct modal_run *run, size_t contact, double time, double rate)
{
    struct march *march = &run->march;
    run->scales[contact] = impact_scale_of(&march->scene, contact, rate);
    run->projects = step_limits_open(&run->limits, &march->scene, contact, &run->scales[contact]);
    run->longest[contact] =
        step_limits_stable(&march->scene, contact, &run->scales[contact], run->limits.coupling);
    march_open(march, contact, time, march->outcome->motion.gap_rate[contact]);
    find_finest(run);
}

/* It ends at `time`; the motion is a little later. */
static void close_contact(struct modal_run *run, size_t contact, double time)
{
    struct march *march = &run->march;
    const struct motion *motion = &march->outcome->motion;
    double since = march->scene.gap_acceleration[contact] * (motion->time - time);
    march_close(march, contact, time, motion->gap_rate[contact] - since);
    find_finest(run);
}

/* A step must not jump over a contact's end, nor pump a mode, nor pass the horizon. */
static int limit_level(const struct modal_run *run, int level, int finest)
{
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        if (!run->march.closed[c])
            continue;
        double left = smaller(run->longest[c], SHARE_TO_OPENING * step_values_opens(run->now + c));
        while (level < finest && step_length(level) > left)
            level++;
    }
    double remaining = run->march.horizon - run->march.outcome->motion.time;
    while (level < STEP_LEVELS - 1 && step_length(level) > remaining)
        level++;
    return level;
}

/* The largest scale of a contact that is closed; 0 where there is but one contact. */
static double group_force(const struct modal_run *run)
{
    double group = 0.0;
    for (size_t c = 0; run->march.scene.contacts > 1 && c < run->march.scene.contacts; c++)
        if (run->march.closed[c])
            group = larger(group, run->scales[c].force);
    return group;
}

/* Force against which a contact's roughness counts: its scale, or what it bears already. */
static double force_scale(const struct modal_run *run, size_t contact, double group)
{
    const double *force = run->step.force[contact];
    double own = larger(larger(force[0], force[1]), larger(force[2], force[3]));
    own = larger(own, run->scales[contact].force);
    return larger(own, SHARE_OF_GROUP * group);
}

/* How much of the contacts' forces the highest coefficient of the step's cubic is. In a group a
 * contact may close after the last node: there the cubic misses the force at the end. */
static double step_roughness(const struct modal_run *run)
{
    double worst = 0.0;
    size_t contacts = run->march.scene.contacts;
    double group = group_force(run);
    for (size_t c = 0; c < contacts; c++) {
        const double *force = run->step.force[c];
        double highest = 0.0;
        for (int j = 0; j < NODES; j++)
            highest += collocation.highest[j] * force[j];
        double off = contacts > 1 ? run->step.end_force[c] - collocation_last(force) : 0.0;
        worst = larger(worst, larger(fabs(highest), fabs(off)) / force_scale(run, c, group));
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
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        closed += run->march.closed[c];
        ends = ends || (run->march.closed[c] && !(run->step.end_indentation[c] > 0.0));
    }
    return closed == 1 && ends;
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
    const struct step_values step = {run->now[c].indentation, end, run->step.indentation[c]};
    struct track_values values = {step.start, end, step.nodes, run->step.force[c],
                                  run->step.stiffness[c]};
    struct contact_start after = step_values_after(&step, h);
    if (!run->march.closed[c] && (end > 0.0 || bears(run, c)))
        open_contact(run, c, start + h * step_values_closing(&step),
                     fmax(run->now[c].rate, after.rate));
    if (run->march.closed[c]) {
        track_step(&run->march.outcome->tracks[c], start, h, &values);
        if (end <= 0.0)
            close_contact(run, c,
                          start +
                              h * (run->projects ? step_ends_release : step_values_release)(&step));
    }
    run->now[c] = after;
}

/* What the nodes miss where contacts begin or end, and where the only one's law has knots. */
static void correct_forces(struct modal_run *run, int level)
{
    const struct scene *scene = &run->march.scene;
    bool corrected = run->projects && step_ends_project_all(scene, run->now, &run->step);
    if (!corrected && scene->contacts == 1)
        corrected = step_knots_pass(&run->step, scene, level, run->now[0].indentation);
    if (corrected)
        run->step.loss =
            contact_step_loss(scene, &run->march.outcome->motion, level, run->step.force);
}

/* Makes the step just solved the present. */
static void accept(struct modal_run *run, int level)
{
    struct impact_outcome *outcome = run->march.outcome;
    double start = outcome->motion.time;
    if (run->projects || (run->yielding.any && run->march.scene.contacts == 1))
        correct_forces(run, level);
    if (run->settings->log)
        force_log_add(run->settings->log, start, level, run->step.force, run->step.indentation);
    contact_step_take(&run->step, &run->march.scene, &outcome->motion);
    run->march.damping += run->step.loss;
    outcome->steps++;
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        keep_books(run, c, start, step_length(level));
}

/* The touch that ended the flight, and starting values of the contacts that are still open. */
static void begin_phase(struct modal_run *run, size_t contact)
{
    const struct motion *motion = &run->march.outcome->motion;
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        double d, rate;
        motion_approach(motion, &run->march.scene, c, &d, &rate);
        run->now[c] = (struct contact_start){c == contact ? 0.0 : fmin(d, 0.0), rate, 0.0, 0.0};
        if (c == contact)
            open_contact(run, c, motion->time, rate);
    }
}

/* Too long: rough, or the only contact ends within it. */
static bool is_coarse(const struct modal_run *run, double roughness)
{
    return roughness > TOO_ROUGH * run->limits.roughness || has_event(run);
}

/* The level after an accepted step. */
static int next_level(const struct modal_run *run, int level, double roughness)
{
    if (roughness < run->limits.roughness / LONGER_ROUGHER && level > 0)
        return level - 1;
    return roughness > run->limits.roughness ? level + 1 : level;
}

/* The level that a phase begins with: contacts of a group close within its steps. */
static int first_level(const struct modal_run *run)
{
    if (run->march.scene.contacts > 1)
        return run->finest;
    int level = step_level(run->scales[0].duration * run->limits.opening_share);
    return level < run->finest ? level : run->finest;
}

/* Solves the step of a level and counts what that took. */
static enum contact_step_end solve_step(struct modal_run *run, int level)
{
    unsigned long before = run->step.iterations;
    enum contact_step_end end = contact_step_solve(&run->step, &run->march.scene,
                                                   &run->march.outcome->motion, level, run->now);
    run->march.used += (run->step.iterations - before) / ITERATIONS_PER_STEP;
    return end;
}

/* Steps until every contact is open again, the horizon, or the limit. */
static enum percuss_end_reason go_through(struct modal_run *run)
{
    struct march *march = &run->march;
    int level = first_level(run);
    while (march_in_contact(march)) {
        if (++march->used > march->most || !pace_keeps(march->pace, march->cost))
            return PERCUSS_END_LIMIT;
        /* the length of the next step */
        int finest = run->finest;
        int deepest = finest + GRAZE_LEVELS < STEP_LEVELS ? finest + GRAZE_LEVELS : STEP_LEVELS - 1;
        level = limit_level(run, level < deepest ? level : deepest, finest);
        if (run->yielding.any)
            level = yielding_level(&run->yielding, level);
        double h = step_length(level), time = march->outcome->motion.time;
        if (time + h == time || march->horizon - time < step_length(deepest))
            return PERCUSS_END_IN_CONTACT;
        /* one that has no solution or is too coarse is tried again with half its length */
        enum contact_step_end end = solve_step(run, level);
        if (end == STEP_MEMORY)
            return march_fail(march, PERCUSS_INTERNAL);
        bool solved = end == STEP_SOLVED;
        double roughness = solved ? step_roughness(run) : INFINITY;
        if (!solved || (level < finest && is_coarse(run, roughness))) {
            if (level >= (solved ? STEP_LEVELS - 1 : deepest))
                return PERCUSS_END_LIMIT;
            march->outcome->rejected++;
            level++;
            continue;
        }
        /* one that passes the instant at which a law changes, with another length or another law */
        if (run->yielding.any && yielding_passes(&run->yielding, h, &level)) {
            if (!unload(run))
                return PERCUSS_END_LIMIT;
            march->outcome->rejected++;
            continue;
        }
        /* one that is taken: the next is as long as its roughness allows */
        accept(run, level);
        level = next_level(run, level, roughness);
        if (run->yielding.any && yielding_meet(&run->yielding, h, &level) && !unload(run))
            return PERCUSS_END_LIMIT;
    }
    return PERCUSS_END_NONE;
}

/* From the first touch on. */
static enum percuss_end_reason contact_phase(void *state, size_t contact)
{
    struct modal_run *run = state;
    begin_phase(run, contact);
    enum percuss_end_reason end = go_through(run);
    contact_step_leave(&run->step, &run->march.scene, &run->march.outcome->motion);
    return end;
}

/* The window ends: contacts that are being loaded yield so far, and all keep what they store. */
static void end_march(void *state)
{
    struct modal_run *run = state;
    yielding_end(&run->yielding);
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        run->march.indentation[c] = run->march.closed[c] ? run->now[c].indentation : 0.0;
}

static bool run_create(struct modal_run *run, struct arena *arena)
{
    const struct scene *scene = &run->march.scene;
    if (!march_create(&run->march, arena))
        return false;
    run->now = arena_take(arena, scene->contacts, sizeof *run->now);
    run->scales = arena_take(arena, scene->contacts, sizeof *run->scales);
    run->longest = arena_take(arena, scene->contacts, sizeof *run->longest);
    run->yielding = (struct yielding){.scene = scene,
                                      .outcome = run->march.outcome,
                                      .step = &run->step,
                                      .now = run->now,
                                      .closed = run->march.closed,
                                      .scales = run->scales,
                                      .accuracy = run->settings->accuracy};
    if (!run->now || !run->scales || !run->longest ||
        !contact_step_create(&run->step, scene, run->settings->accuracy, arena) ||
        !yielding_create(&run->yielding, arena))
        return false;
    run->step.pace = run->march.pace;
    step_limits_project(&run->limits, scene, run->settings);
    return true;
}

enum percuss_status impact_modal(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome)
{
    static const struct march_method method = {.contact_phase = contact_phase, .end = end_march};
    struct modal_run run = {.march = {.stated = scene,
                                      .outcome = outcome,
                                      .horizon = settings->horizon,
                                      .accuracy = settings->accuracy,
                                      .most = impact_max_steps(scene, settings),
                                      .pace = settings->pace},
                            .settings = settings,
                            .limits = step_limits_make(scene, settings->accuracy, settings->care)};
    return run_create(&run, arena) ? march_run(&run.march, &method, &run, arena) : PERCUSS_INTERNAL;
}
