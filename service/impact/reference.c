/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The independent reference: the whole scene as one system of ordinary differential equations,
 * solved by CVODE (Adams) with root finding. It shares the scene and the laws with the modal
 * method, and nothing of its time integration. */
#include <math.h>

#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/flight_root.h"
#include "impact/impact_scale.h"
#include "impact/march.h"
#include "impact/reference_system.h"
#include "numeric/ode.h"

/* The impulse's error gathers from many steps: CVODE's relative tolerance is this share of the
 * accuracy asked for, but not beyond rounding. */
static const double SHARE_OF_ACCURACY = 0.01;
static const double LEAST_TOLERANCE = 1e-14;

/* A contact that starts nearer than this share of its indentation's scale has touched. */
static const double TOUCHING = 1e-12;

/* A force is none below this share of that of a collision with all the energy: rounding. */
static const double NO_FORCE = 1e-9;

/* CVODE sees roots between its steps only: this angle of the fastest mode (pi/4, an eighth of its
 * period) is the longest step. */
static const double LONGEST_ANGLE = 0.25 * M_PI;

/* Passes over the modes in a step: right-hand sides, and the steps that CVODE remembers. */
static const double PASSES = 10.0;

struct reference {
    struct march march;
    struct reference_system system;
    double accuracy;
    struct ode *ode; /* NULL: not begun */
    double *y;
    double *opened; /* [contact] impulse when the sub-impact began */
    double *noted;  /* [contact] impulse whose moment is noted */
};

static bool reference_create(struct reference *run, struct arena *arena)
{
    if (!march_create(&run->march, arena) ||
        !reference_system_create(&run->system, &run->march.scene, arena))
        return false;
    run->opened = arena_take(arena, run->march.scene.contacts, sizeof(double));
    run->noted = arena_take(arena, run->march.scene.contacts, sizeof(double));
    run->y = arena_take(arena, run->system.size, sizeof(double));
    return run->opened && run->noted && run->y;
}

static void open_contact(struct reference *run, size_t c, double t)
{
    size_t n = run->march.scene.contacts;
    run->system.indentation[c] = 0.0;
    run->opened[c] = run->y[2 * n + c];
    march_open(&run->march, c, t, run->y[n + c]);
}

/* The books of a contact that is closed: its largest indentation so far, at an instant. */
static void note_largest(struct reference *run, size_t c, double t)
{
    struct track *track = &run->march.outcome->tracks[c];
    double indentation = run->system.indentation[c] + track->deepened;
    if (!(indentation > track->open.max_indentation))
        return;
    track->open.max_indentation = indentation;
    track->open.compression_end = t;
    track->open.compression_impulse = run->y[2 * run->march.scene.contacts + c] - run->opened[c];
}

static void note_impulse(struct reference *run, size_t c)
{
    run->march.outcome->tracks[c].open.impulse =
        run->y[2 * run->march.scene.contacts + c] - run->opened[c];
}

/* The largest indentation beyond the limit, if it is: the dent deepens. */
static void yield(struct reference *run, size_t c)
{
    struct impact_outcome *outcome = run->march.outcome;
    struct contact_law *law = &outcome->laws[c];
    if (!(run->system.indentation[c] > contact_law_limit(law)))
        return;
    double before = law->history.dent;
    outcome->plastic += contact_law_yield(law, run->system.indentation[c]);
    double deeper = law->history.dent - before;
    run->y[c] += deeper;
    run->system.indentation[c] -= deeper;
    outcome->tracks[c].deepened += deeper;
    /* as the modal method finds it; here the solution goes on */
    if (!contact_bears(&run->march.scene, c, contact_law_unloading(law)))
        outcome->too_stiff = true;
}

/* Bookkeeping at a root: contacts open and close, indentations peak. */
static void handle_roots(struct reference *run, double t, const int *found)
{
    struct march *march = &run->march;
    size_t n = march->scene.contacts;
    /* contacts that open and close */
    for (size_t c = 0; c < n; c++) {
        int opens = found[run->system.roots * c];
        if (opens > 0 && !march->closed[c]) {
            open_contact(run, c, t);
        } else if (opens < 0 && march->closed[c]) {
            note_impulse(run, c);
            march_close(march, c, t, run->y[n + c]);
        }
    }
    /* indentations at their largest: a law may yield there */
    reference_system_forces(&run->system, run->y);
    for (size_t c = 0; c < n; c++) {
        if (!march->closed[c] || found[run->system.roots * c + 1] >= 0)
            continue;
        note_largest(run, c, t);
        yield(run, c);
    }
}

/* CVODE does not report the rise of a root function that was exactly zero at a start: a contact
 * that touched at rest. Its force is right all the same, only the books are opened a step late. */
static void open_unreported(struct reference *run, double t)
{
    reference_system_forces(&run->system, run->y);
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        if (!run->march.closed[c] && run->system.force[c] > 0.0 &&
            run->system.force[c] > NO_FORCE * run->system.absolute_force[c])
            open_contact(run, c, t);
}

/* Whether vibration can cause no further contact, by the bound of the modes' amplitudes. */
static bool is_complete(struct reference *run, const double *y)
{
    const struct scene *scene = &run->march.scene;
    double left = run->march.horizon - run->march.outcome->motion.time;
    reference_system_unpack(&run->system, y, &run->system.motion);
    for (size_t c = 0; c < scene->contacts; c++) {
        /* what vibration can bridge: sum |phi| sqrt(q^2 + v^2/omega^2) */
        double bound = 0.0;
        for (size_t g = 0; g < scene->groups; g++) {
            const struct scene_group *group = &scene->group[g];
            for (size_t k = 0; group->participation[c] && k < group->count; k++)
                bound += fabs(group->participation[c][k]) *
                         hypot(run->system.motion.q[g][k],
                               run->system.motion.v[g][k] / group->set->omega[k]);
        }
        /* whether the rigid gap exceeds it from now on */
        double first;
        double last;
        double excess = run->system.motion.gap[c] - bound;
        double rate = flight_root_rate(excess, run->system.motion.gap_rate[c],
                                       march_unknown_rate(&run->march, c), left);
        flight_root_exceeds(excess, rate, scene->gap_acceleration[c], &first, &last);
        if (run->march.closed[c] || first > 0.0)
            return false;
    }
    return true;
}

/* After a root at which the right-hand side is not smooth: where a contact opens or closes, and
 * where a law may have yielded at a peak. */
static bool must_restart(const struct reference *run, const int *found)
{
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        for (size_t r = 0; r < run->system.roots; r++)
            if ((r == 0 || run->system.roots > 2) && found[run->system.roots * c + r])
                return true;
    return false;
}

/* Of the impulses of a step, which is far shorter than a contact, about its middle. */
static void note_moments(struct reference *run, double before, double now)
{
    size_t n = run->march.scene.contacts;
    for (size_t c = 0; c < n; c++) {
        double impulse = run->y[2 * n + c] - run->noted[c];
        run->march.outcome->tracks[c].moment += 0.5 * (before + now) * impulse;
        run->noted[c] += impulse;
    }
}

static enum percuss_end_reason integrate(struct reference *run)
{
    struct march *march = &run->march;
    double *now = &march->outcome->motion.time;
    int found[3 * PERCUSS_MAX_CONTACTS];
    double cost = PASSES * march->cost;
    for (unsigned long used = 0; used < march->most && pace_keeps(march->pace, cost); used++) {
        /* one step, to a root at most */
        double before = *now;
        enum ode_event event = ode_step(run->ode, march->horizon, now, run->y, found);
        if (event == ODE_FAILED)
            return PERCUSS_END_LIMIT;
        note_moments(run, before, *now);
        /* contacts and laws that change, from which the solver starts anew */
        if (event == ODE_ROOT) {
            handle_roots(run, *now, found);
            if (must_restart(run, found) && !ode_set(run->ode, *now, run->y))
                return PERCUSS_END_LIMIT;
        }
        if (event == ODE_STEP)
            open_unreported(run, *now);
        /* the end of the window, or no touch can follow */
        bool closed = march_in_contact(march);
        if (event == ODE_REACHED)
            return closed ? PERCUSS_END_IN_CONTACT : PERCUSS_END_HORIZON;
        if (!closed && is_complete(run, run->y))
            return march_parted(march);
    }
    return PERCUSS_END_LIMIT;
}

/* The whole impact, from its start on. */
static enum percuss_end_reason solve(void *state, size_t contact)
{
    struct reference *run = state;
    struct march *march = &run->march;
    const struct scene *scene = &march->scene;
    struct motion *motion = &march->outcome->motion;
    (void)contact;
    /* the system, its tolerances and its solver */
    reference_system_tolerate(&run->system, motion, SHARE_OF_ACCURACY * run->accuracy);
    reference_system_pack(&run->system, motion, run->y);
    run->ode = ode_create(&(struct ode_problem){
        .size = run->system.size,
        .root_count = run->system.roots * scene->contacts,
        .rhs = reference_system_rates,
        .roots = reference_system_roots,
        .context = &run->system,
        .relative = fmax(SHARE_OF_ACCURACY * run->accuracy, LEAST_TOLERANCE),
        .absolute = run->system.absolute,
    });
    if (!run->ode)
        return march_fail(march, PERCUSS_INTERNAL);
    /* contacts that touch at the start */
    for (size_t c = 0; c < scene->contacts; c++) {
        motion_approach(motion, scene, c, &run->system.approach[c], &run->system.rate[c]);
        double near = TOUCHING * impact_scale_of(scene, c, run->system.rate[c]).indentation;
        if (run->system.approach[c] >= -near && run->system.rate[c] > 0.0)
            open_contact(run, c, motion->time);
    }
    /* from there on, in steps that miss no root */
    double fastest = scene_highest_frequency(scene);
    bool ready = ode_set(run->ode, motion->time, run->y) &&
                 (fastest == 0.0 || ode_set_longest_step(run->ode, LONGEST_ANGLE / fastest));
    return ready ? integrate(run) : PERCUSS_END_LIMIT;
}

static void end_march(void *state)
{
    struct reference *run = state;
    struct march *march = &run->march;
    if (!run->ode)
        return;
    /* contacts that are being loaded yield so far */
    reference_system_forces(&run->system, run->y);
    for (size_t c = 0; c < march->scene.contacts; c++)
        if (march->closed[c])
            yield(run, c);
    /* the motion, and the books of contacts that are closed still */
    reference_system_unpack(&run->system, run->y, &march->outcome->motion);
    for (size_t c = 0; c < march->scene.contacts; c++) {
        if (!march->closed[c])
            continue;
        note_largest(run, c, march->outcome->motion.time);
        note_impulse(run, c);
        march->indentation[c] = run->system.indentation[c];
    }
    march->damping = run->y[3 * march->scene.contacts];
    /* what it took */
    unsigned long evaluations;
    ode_effort(run->ode, &evaluations, &march->outcome->steps);
    march->used = march->outcome->steps + evaluations;
}

enum percuss_status impact_cvode(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome)
{
    static const struct march_method method = {
        .flies = true, .contact_phase = solve, .end = end_march};
    struct reference run = {.march = {.stated = scene,
                                      .outcome = outcome,
                                      .horizon = settings->horizon,
                                      .accuracy = settings->accuracy,
                                      .most = impact_max_steps(scene, settings),
                                      .pace = settings->pace},
                            .accuracy = settings->accuracy};
    if (!reference_create(&run, arena))
        return PERCUSS_INTERNAL;
    enum percuss_status status = march_run(&run.march, &method, &run, arena);
    ode_free(run.ode);
    return status;
}
