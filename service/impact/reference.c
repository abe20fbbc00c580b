/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The independent reference: the whole scene as one system of ordinary differential equations,
 * solved by CVODE (Adams) with root finding. It shares the scene and the laws with the modal
 * method, and nothing of its time integration. */
#include <math.h>
#include <string.h>

#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/energy.h"
#include "impact/flight_root.h"
#include "impact/impact.h"
#include "impact/impact_scale.h"
#include "impact/rewind.h"
#include "impact/step_cost.h"
#include "numeric/ode.h"

/* y: [contacts] gaps, [contacts] gap rates, [contacts] impulses, 1 damping loss, then every group's
 * q and v. Root functions: per contact the local indentation, the approach rate and, where a law
 * yields, the indentation above the limit of what can be undone. */
struct reference {
    const struct scene *scene; /* with the laws of the outcome, which change as they yield */
    struct scene own;
    size_t roots;         /* root functions of a contact */
    struct motion motion; /* the state unpacked */
    size_t size;
    bool *active;   /* [contact] a sub-impact is under way */
    bool *everyone; /* [contact] true: the laws themselves know when a contact is open */
    double *approach, *rate, *indentation, *force, *matrix;
    double *y, *absolute;
    double *absolute_force; /* [contact] of a collision with all the energy, N */
    double *opened;         /* [contact] impulse when the sub-impact began */
};

static size_t oscillator_count(const struct scene *scene)
{
    size_t count = 0;
    for (size_t g = 0; g < scene->groups; g++)
        count += scene->group[g].count;
    return count;
}

static void unpack(const struct reference *run, const double *y, struct motion *motion)
{
    size_t n = run->scene->contacts;
    memcpy(motion->gap, y, n * sizeof *y);
    memcpy(motion->gap_rate, y + n, n * sizeof *y);
    const double *next = y + 3 * n + 1;
    for (size_t g = 0; g < run->scene->groups; g++) {
        size_t count = run->scene->group[g].count;
        memcpy(motion->q[g], next, count * sizeof *y);
        memcpy(motion->v[g], next + count, count * sizeof *y);
        next += 2 * count;
    }
}

static void pack(const struct reference *run, const struct motion *motion, double *y)
{
    size_t n = run->scene->contacts;
    memset(y, 0, run->size * sizeof *y);
    memcpy(y, motion->gap, n * sizeof *y);
    memcpy(y + n, motion->gap_rate, n * sizeof *y);
    double *next = y + 3 * n + 1;
    for (size_t g = 0; g < run->scene->groups; g++) {
        size_t count = run->scene->group[g].count;
        memcpy(next, motion->q[g], count * sizeof *y);
        memcpy(next + count, motion->v[g], count * sizeof *y);
        next += 2 * count;
    }
}

/* Approaches, local indentations and forces of a state. */
static void find_forces(struct reference *run, const double *y)
{
    unpack(run, y, &run->motion);
    for (size_t c = 0; c < run->scene->contacts; c++) {
        motion_approach(&run->motion, run->scene, c, &run->approach[c], &run->rate[c]);
        if (!(run->indentation[c] > 0.0))
            run->indentation[c] = fmax(0.0, run->approach[c]);
    }
    contact_local_indentation(run->scene, run->everyone, run->approach, run->indentation,
                              run->force, run->matrix);
}

static void rhs(double t, const double *y, double *rate, void *context)
{
    (void)t;
    struct reference *run = context;
    const struct scene *scene = run->scene;
    size_t n = scene->contacts;
    find_forces(run, y);
    for (size_t i = 0; i < n; i++) {
        rate[i] = y[n + i];
        rate[n + i] = scene->gap_acceleration[i];
        for (size_t j = 0; j < n; j++)
            rate[n + i] += scene->w[i * n + j] * run->force[j];
        rate[2 * n + i] = run->force[i];
    }
    double loss = 0.0;
    double *next = rate + 3 * n + 1;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        double damping = group->set->damping;
        for (size_t k = 0; k < group->count; k++) {
            double omega = group->set->omega[k];
            double q = run->motion.q[g][k];
            double v = run->motion.v[g][k];
            double push = 0.0;
            for (size_t c = 0; c < n; c++)
                if (group->participation[c])
                    push += group->participation[c][k] * run->force[c];
            next[k] = v;
            next[group->count + k] = push - omega * (2.0 * damping * v + omega * q);
            loss += 2.0 * damping * omega * v * v;
        }
        next += 2 * group->count;
    }
    rate[3 * n] = loss;
}

static void roots(double t, const double *y, double *values, void *context)
{
    (void)t;
    struct reference *run = context;
    find_forces(run, y);
    for (size_t c = 0; c < run->scene->contacts; c++) {
        double *value = values + run->roots * c;
        value[0] = run->indentation[c];
        value[1] = run->rate[c];
        if (run->roots > 2)
            value[2] = run->indentation[c] - fmin(contact_law_limit(&run->scene->laws[c]), 1e3);
    }
}

/* Absolute tolerances from the energy at hand, so that no unit is favoured. */
static void set_absolute(struct reference *run, double relative)
{
    const struct scene *scene = run->scene;
    size_t n = scene->contacts;
    double energy = 1e-300;
    for (size_t c = 0; c < n; c++) {
        double v = scene->gap_rate[c];
        energy += 0.5 * v * v / scene->w[c * n + c];
    }
    for (size_t g = 0; g < scene->groups; g++)
        for (size_t b = 0; b < scene->bodies; b++)
            energy += motion_vibration(&run->motion, scene, b) / (double)scene->groups;
    for (size_t c = 0; c < n; c++) {
        double v = sqrt(2.0 * energy * scene->w[c * n + c]);
        struct impact_scale scale = impact_scale_of(scene, c, v);
        run->absolute_force[c] = scale.force;
        run->absolute[c] = relative * scale.indentation;
        run->absolute[n + c] = relative * v;
        run->absolute[2 * n + c] = relative * v / scene->w[c * n + c];
    }
    run->absolute[3 * n] = relative * energy;
    double *next = run->absolute + 3 * n + 1;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        for (size_t k = 0; k < group->count; k++) {
            next[k] = relative * sqrt(2.0 * energy) / group->set->omega[k];
            next[group->count + k] = relative * sqrt(2.0 * energy);
        }
        next += 2 * group->count;
    }
}

static bool reference_create(struct reference *run, const struct scene *scene, struct arena *arena)
{
    size_t n = scene->contacts;
    *run = (struct reference){.own = *scene, .roots = 2};
    run->scene = &run->own;
    for (size_t c = 0; c < n; c++)
        if (scene->laws[c].operations->curve)
            run->roots = 3;
    run->size = 3 * n + 1 + 2 * oscillator_count(scene);
    run->active = arena_take(arena, n, sizeof *run->active);
    run->everyone = arena_take(arena, n, sizeof *run->everyone);
    run->approach = arena_take(arena, n, sizeof(double));
    run->rate = arena_take(arena, n, sizeof(double));
    run->indentation = arena_take(arena, n, sizeof(double));
    run->force = arena_take(arena, n, sizeof(double));
    run->opened = arena_take(arena, n, sizeof(double));
    run->absolute_force = arena_take(arena, n, sizeof(double));
    run->matrix = arena_take(arena, n * n, sizeof(double));
    run->y = arena_take(arena, run->size, sizeof(double));
    run->absolute = arena_take(arena, run->size, sizeof(double));
    for (size_t c = 0; run->everyone && c < n; c++)
        run->everyone[c] = true;
    return run->active && run->everyone && run->approach && run->rate && run->indentation &&
           run->force && run->opened && run->absolute_force && run->matrix && run->y &&
           run->absolute && motion_create(&run->motion, scene, arena);
}

static void open_contact(struct reference *run, struct impact_outcome *outcome, size_t c, double t,
                         const double *y)
{
    run->active[c] = true;
    run->indentation[c] = 0.0;
    run->opened[c] = y[2 * run->scene->contacts + c];
    track_open(&outcome->tracks[c], t, y[run->scene->contacts + c]);
}

static void close_contact(struct reference *run, struct impact_outcome *outcome, size_t c, double t,
                          const double *y)
{
    struct sub_impact *open = &outcome->tracks[c].open;
    open->impulse = y[2 * run->scene->contacts + c] - run->opened[c];
    run->active[c] = false;
    track_close(&outcome->tracks[c], &run->scene->laws[c], t, y[run->scene->contacts + c]);
}

/* The largest indentation beyond the limit: the dent deepens. */
static void yield(struct reference *run, struct impact_outcome *outcome, size_t c, double *y)
{
    struct contact_law *law = &outcome->laws[c];
    double before = law->history.residual;
    outcome->plastic += contact_law_yield(law, run->indentation[c]);
    double deeper = law->history.residual - before;
    y[c] += deeper;
    run->indentation[c] -= deeper;
    outcome->tracks[c].deepened += deeper;
}

/* Bookkeeping at a root: contacts open and close, indentations peak. */
static void handle_roots(struct reference *run, struct impact_outcome *outcome, double t, double *y,
                         const int *found)
{
    for (size_t c = 0; c < run->scene->contacts; c++) {
        int opens = found[run->roots * c];
        if (opens > 0 && !run->active[c])
            open_contact(run, outcome, c, t, y);
        else if (opens < 0 && run->active[c])
            close_contact(run, outcome, c, t, y);
    }
    find_forces(run, y);
    for (size_t c = 0; c < run->scene->contacts; c++) {
        struct sub_impact *open = &outcome->tracks[c].open;
        double indentation = run->indentation[c] + outcome->tracks[c].deepened;
        if (!run->active[c] || found[run->roots * c + 1] >= 0)
            continue;
        if (indentation > open->max_indentation) {
            open->max_indentation = indentation;
            open->compression_end = t;
            open->compression_impulse = y[2 * run->scene->contacts + c] - run->opened[c];
        }
        if (run->indentation[c] > contact_law_limit(&run->scene->laws[c]))
            yield(run, outcome, c, y);
    }
}

/* CVODE does not report the rise of a root function that was exactly zero at a start: a contact
 * that touched at rest. Its force is right all the same, only the books are opened a step late. */
static void open_unreported(struct reference *run, struct impact_outcome *outcome, double t,
                            const double *y)
{
    find_forces(run, y);
    for (size_t c = 0; c < run->scene->contacts; c++)
        if (!run->active[c] && run->force[c] > 0.0 && run->force[c] > 1e-9 * run->absolute_force[c])
            open_contact(run, outcome, c, t, y);
}

/* Whether vibration can cause no further contact, by the bound of the modes' amplitudes. */
static bool is_complete(struct reference *run, const double *y)
{
    const struct scene *scene = run->scene;
    unpack(run, y, &run->motion);
    for (size_t c = 0; c < scene->contacts; c++) {
        double bound = 0.0;
        for (size_t g = 0; g < scene->groups; g++) {
            const struct scene_group *group = &scene->group[g];
            for (size_t k = 0; group->participation[c] && k < group->count; k++)
                bound += fabs(group->participation[c][k]) *
                         hypot(run->motion.q[g][k], run->motion.v[g][k] / group->set->omega[k]);
        }
        double first;
        double last;
        flight_root_exceeds(run->motion.gap[c] - bound, run->motion.gap_rate[c],
                            scene->gap_acceleration[c], &first, &last);
        if (run->active[c] || first > 0.0)
            return false;
    }
    return true;
}

static enum percuss_end_reason integrate(struct reference *run, struct ode *ode,
                                         const struct impact_settings *settings,
                                         struct impact_outcome *outcome, double *t)
{
    int found[3 * PERCUSS_MAX_CONTACTS];
    unsigned long max_steps = impact_max_steps(run->scene, settings);
    /* some ten passes over the modes in a step: right-hand sides, and the history of the steps */
    double cost = 10.0 * step_cost(run->scene);
    for (unsigned long used = 0; used < max_steps && pace_keeps(settings->pace, cost); used++) {
        enum ode_event event = ode_step(ode, settings->horizon, t, run->y, found);
        if (event == ODE_FAILED)
            return PERCUSS_END_LIMIT;
        bool any = false;
        if (event == ODE_ROOT) {
            handle_roots(run, outcome, *t, run->y, found);
            /* the right-hand side is not smooth here: start afresh */
            bool restart = false;
            for (size_t c = 0; c < run->scene->contacts; c++)
                for (size_t r = 0; r < run->roots; r++)
                    restart = restart || ((r == 0 || run->roots > 2) && found[run->roots * c + r]);
            if (restart && !ode_set(ode, *t, run->y))
                return PERCUSS_END_LIMIT;
        }
        if (event == ODE_STEP)
            open_unreported(run, outcome, *t, run->y);
        for (size_t c = 0; c < run->scene->contacts; c++)
            any = any || run->active[c];
        if (event == ODE_REACHED)
            return any ? PERCUSS_END_IN_CONTACT : PERCUSS_END_HORIZON;
        if (!any && is_complete(run, run->y)) {
            for (size_t c = 0; c < run->scene->contacts; c++)
                if (run->scene->gap_acceleration[c] < 0.0)
                    return PERCUSS_END_HANDED_BACK;
            return PERCUSS_END_SEPARATED;
        }
    }
    return PERCUSS_END_LIMIT;
}

static enum rewind_end start(struct reference *run, const struct impact_settings *settings,
                             struct arena *arena, struct impact_outcome *outcome)
{
    const struct scene *scene = run->scene;
    struct rewind rewind = {settings->horizon, impact_max_steps(scene, settings), arena,
                            settings->pace, false};
    motion_start(&run->motion, scene);
    enum rewind_end found = rewind_to_touch(&rewind, scene, &run->motion, &outcome->time_shift);
    outcome->beyond_horizon = rewind.beyond;
    if (found == REWIND_NEVER)
        return found;
    set_absolute(run, 0.01 * settings->accuracy);
    pack(run, &run->motion, run->y);
    for (size_t c = 0; c < scene->contacts; c++) {
        motion_approach(&run->motion, scene, c, &run->approach[c], &run->rate[c]);
        double near = 1e-12 * impact_scale_of(scene, c, run->rate[c]).indentation;
        if (run->approach[c] >= -near && run->rate[c] > 0.0)
            open_contact(run, outcome, c, outcome->time_shift, run->y);
    }
    return found;
}

/* Start of the first sub-impact of all, 0 when there is none. */
static double first_touch(const struct scene *scene, const struct impact_outcome *outcome)
{
    double first = INFINITY;
    for (size_t c = 0; c < scene->contacts; c++)
        if (outcome->tracks[c].count)
            first = fmin(first, outcome->tracks[c].list[0].start);
    return isfinite(first) ? first : 0.0;
}

static bool finish(struct reference *run, const struct scene *scene, double t, struct arena *arena,
                   struct impact_outcome *outcome)
{
    find_forces(run, run->y);
    for (size_t c = 0; c < scene->contacts; c++)
        if (run->active[c] && run->indentation[c] > contact_law_limit(&outcome->laws[c]))
            yield(run, outcome, c, run->y);
    unpack(run, run->y, &outcome->motion);
    outcome->motion.time = outcome->window = t;
    for (size_t c = 0; c < scene->contacts; c++) {
        struct track *track = &outcome->tracks[c];
        if (!run->active[c]) {
            run->indentation[c] = 0.0;
        } else {
            double indentation = run->indentation[c] + track->deepened;
            if (indentation > track->open.max_indentation) {
                track->open.max_indentation = indentation;
                track->open.compression_end = t;
                track->open.compression_impulse = run->y[2 * scene->contacts + c] - run->opened[c];
            }
            close_contact(run, outcome, c, t, run->y);
        }
        track_mark_negligible(track);
    }
    if (outcome->time_shift == 0.0)
        outcome->time_shift = first_touch(scene, outcome);
    return energy_audit(scene, run->indentation, run->y[3 * scene->contacts], arena, outcome);
}

enum percuss_status impact_cvode(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome)
{
    struct reference run;
    impact_begin(outcome, scene);
    if (!reference_create(&run, scene, arena))
        return PERCUSS_INTERNAL;
    run.own.laws = outcome->laws;
    enum rewind_end found = start(&run, settings, arena, outcome);
    outcome->always_overlapped = found == REWIND_NEVER;
    if (outcome->always_overlapped)
        return PERCUSS_OK;
    struct ode *ode = ode_create(&(struct ode_problem){
        .size = run.size,
        .root_count = run.roots * scene->contacts,
        .rhs = rhs,
        .roots = roots,
        .context = &run,
        .relative = fmax(0.01 * settings->accuracy, 1e-14),
        .absolute = run.absolute,
    });
    if (!ode)
        return PERCUSS_INTERNAL;
    double t = outcome->time_shift;
    /* CVODE sees roots between its steps only: at least eight of them in the fastest period */
    double fastest = scene_highest_frequency(scene);
    bool ready = found == REWIND_TOUCHED && ode_set(ode, t, run.y) &&
                 (fastest == 0.0 || ode_set_longest_step(ode, 0.25 * M_PI / fastest));
    outcome->end_reason = ready ? integrate(&run, ode, settings, outcome, &t) : PERCUSS_END_LIMIT;
    unsigned long evaluations;
    ode_effort(ode, &evaluations, &outcome->steps);
    outcome->rejected = 0;
    outcome->intervals = evaluations;
    outcome->effort = outcome->steps + evaluations;
    ode_free(ode);
    return finish(&run, scene, t, arena, outcome) ? pace_status(settings->pace) : PERCUSS_INTERNAL;
}
