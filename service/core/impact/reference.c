/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The independent reference: the whole scene as one system of ordinary differential equations,
 * solved by CVODE (Adams) with root finding. It shares the scene and the laws with the modal
 * method, and nothing of its time integration. */
#include <math.h>
#include <string.h>

#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/flight_root.h"
#include "impact/impact_scale.h"
#include "impact/march.h"
#include "impact/motion.h"
#include "numeric/ode.h"

/* ---- The system for CVODE ---- */

/* A whole scene as one system of ordinary differential equations, for a general solver.
 *
 * y: [contacts] gaps, [contacts] gap rates, [contacts] impulses, 1 damping loss, then every group's
 * q and v. Root functions: per contact the local indentation, the approach rate and, where a law
 * yields, the indentation beyond the elastic limit. */
struct reference_system {
    const struct scene *scene;
    size_t roots;                                           /* root functions of a contact */
    size_t size;                                            /* of y */
    struct motion motion;                                   /* a state unpacked */
    double *approach, *rate, *indentation, *force, *matrix; /* [contact]; matrix: contacts^2 */
    double *absolute;                                       /* [size] absolute tolerances */
    double *absolute_force; /* [contact] of a collision with all the energy, N */
};

/* A root function must be finite; every indentation is smaller than this, m. */
static const double ENDLESS = 1e3;

/* Energy of bodies at rest, J, as tolerances must not be 0. */
static const double LEAST_ENERGY = 1e-300;

static size_t oscillator_count(const struct scene *scene)
{
    size_t count = 0;
    for (size_t g = 0; g < scene->groups; g++)
        count += scene->group[g].count;
    return count;
}

/* False: out of memory. */
static bool reference_system_create(struct reference_system *system, const struct scene *scene,
                                    struct arena *arena)
{
    size_t n = scene->contacts;
    *system = (struct reference_system){.scene = scene, .roots = 2};
    /* a third root function of laws that yield */
    for (size_t c = 0; c < n; c++)
        if (scene->laws[c].operations->curve)
            system->roots = 3;
    /* gaps, their rates, impulses, the loss, and the modes */
    system->size = 3 * n + 1 + 2 * oscillator_count(scene);
    system->approach = arena_take(arena, n, sizeof(double));
    system->rate = arena_take(arena, n, sizeof(double));
    system->indentation = arena_take(arena, n, sizeof(double));
    system->force = arena_take(arena, n, sizeof(double));
    system->absolute_force = arena_take(arena, n, sizeof(double));
    system->matrix = arena_take(arena, n * n, sizeof(double));
    system->absolute = arena_take(arena, system->size, sizeof(double));
    return system->approach && system->rate && system->indentation && system->force &&
           system->absolute_force && system->matrix && system->absolute &&
           motion_create(&system->motion, scene, arena);
}

static void reference_system_unpack(const struct reference_system *system, const double *y,
                                    struct motion *motion)
{
    size_t n = system->scene->contacts;
    memcpy(motion->gap, y, n * sizeof *y);
    memcpy(motion->gap_rate, y + n, n * sizeof *y);
    const double *next = y + 3 * n + 1;
    for (size_t g = 0; g < system->scene->groups; g++) {
        size_t count = system->scene->group[g].count;
        memcpy(motion->q[g], next, count * sizeof *y);
        memcpy(motion->v[g], next + count, count * sizeof *y);
        next += 2 * count;
    }
}

static void reference_system_pack(const struct reference_system *system,
                                  const struct motion *motion, double *y)
{
    size_t n = system->scene->contacts;
    memset(y, 0, system->size * sizeof *y);
    memcpy(y, motion->gap, n * sizeof *y);
    memcpy(y + n, motion->gap_rate, n * sizeof *y);
    double *next = y + 3 * n + 1;
    for (size_t g = 0; g < system->scene->groups; g++) {
        size_t count = system->scene->group[g].count;
        memcpy(next, motion->q[g], count * sizeof *y);
        memcpy(next + count, motion->v[g], count * sizeof *y);
        next += 2 * count;
    }
}

/* Finds motion, approaches, local indentations and forces of a state. */
static void reference_system_forces(struct reference_system *system, const double *y)
{
    reference_system_unpack(system, y, &system->motion);
    for (size_t c = 0; c < system->scene->contacts; c++) {
        motion_approach(&system->motion, system->scene, c, &system->approach[c], &system->rate[c]);
        if (!(system->indentation[c] > 0.0))
            system->indentation[c] = fmax(0.0, system->approach[c]);
    }
    contact_local_indentation(system->scene, system->approach, system->indentation, system->force,
                              system->matrix);
}

/* dy/dt and the root functions, see ode.h; `context`: the system. */
static void reference_system_rates(double t, const double *y, double *rate, void *context)
{
    (void)t;
    struct reference_system *system = context;
    const struct scene *scene = system->scene;
    size_t n = scene->contacts;
    reference_system_forces(system, y);
    /* gaps g'' = a + W F, impulses J' = F */
    for (size_t i = 0; i < n; i++) {
        rate[i] = y[n + i];
        rate[n + i] = scene->gap_acceleration[i];
        for (size_t j = 0; j < n; j++)
            rate[n + i] += scene->w[i * n + j] * system->force[j];
        rate[2 * n + i] = system->force[i];
    }
    /* modes q'' = sum_c phi_c F_c - 2 zeta omega q' - omega^2 q, and the damping loss */
    double loss = 0.0;
    double *next = rate + 3 * n + 1;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        for (size_t k = 0; k < group->count; k++) {
            double omega = group->set->omega[k];
            double damping = group->set->damping[k];
            double q = system->motion.q[g][k];
            double v = system->motion.v[g][k];
            double push = 0.0;
            for (size_t c = 0; c < n; c++)
                if (group->participation[c])
                    push += group->participation[c][k] * system->force[c];
            next[k] = v;
            next[group->count + k] = push - omega * (2.0 * damping * v + omega * q);
            loss += 2.0 * damping * omega * v * v;
        }
        next += 2 * group->count;
    }
    rate[3 * n] = loss;
}

static void reference_system_roots(double t, const double *y, double *values, void *context)
{
    (void)t;
    struct reference_system *system = context;
    reference_system_forces(system, y);
    for (size_t c = 0; c < system->scene->contacts; c++) {
        double *value = values + system->roots * c;
        value[0] = system->indentation[c];
        value[1] = system->rate[c];
        if (system->roots > 2)
            value[2] =
                system->indentation[c] - fmin(contact_law_limit(&system->scene->laws[c]), ENDLESS);
    }
}

/* Sets the absolute tolerances from the energy of a motion, so that they are independent of
 * units. */
static void reference_system_tolerate(struct reference_system *system, const struct motion *motion,
                                      double relative)
{
    const struct scene *scene = system->scene;
    size_t n = scene->contacts;
    /* the energy of the approaches and of vibration */
    double energy = LEAST_ENERGY;
    for (size_t c = 0; c < n; c++) {
        double v = scene->gap_rate[c];
        energy += 0.5 * v * v / scene->w[c * n + c];
    }
    for (size_t g = 0; g < scene->groups; g++)
        for (size_t b = 0; b < scene->bodies; b++)
            energy += motion_vibration(motion, scene, b) / (double)scene->groups;
    /* a contact with all the energy: force, gap, rate and impulse */
    for (size_t c = 0; c < n; c++) {
        double v = sqrt(2.0 * energy * scene->w[c * n + c]);
        struct impact_scale scale = impact_scale_of(scene, c, v);
        system->absolute_force[c] = scale.force;
        system->absolute[c] = relative * scale.indentation;
        system->absolute[n + c] = relative * v;
        system->absolute[2 * n + c] = relative * v / scene->w[c * n + c];
    }
    system->absolute[3 * n] = relative * energy;
    /* a mode with all the energy */
    double *next = system->absolute + 3 * n + 1;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        for (size_t k = 0; k < group->count; k++) {
            next[k] = relative * sqrt(2.0 * energy) / group->set->omega[k];
            next[group->count + k] = relative * sqrt(2.0 * energy);
        }
        next += 2 * group->count;
    }
}

/* ---- The method ---- */

/* The impulse's error adds up over many steps: CVODE's relative tolerance is this share of the
 * accuracy, but at least LEAST_TOLERANCE because of rounding. */
static const double SHARE_OF_ACCURACY = 0.01;
static const double LEAST_TOLERANCE = 1e-14;

/* A contact that starts nearer than this share of its indentation's scale has touched. */
static const double TOUCHING = 1e-12;

/* A force below this share of that of a collision with all the energy is rounding. */
static const double NO_FORCE = 1e-9;

/* CVODE finds a root only by a change of sign over a step: this angle of the fastest mode (pi/4, an
 * eighth of its period) is the longest step. */
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
    double *noted;  /* [contact] impulse of which the moment is noted */
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

/* Deepens the dent where the indentation exceeds the limit. */
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
    /* as in the modal method, but the solution goes on */
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
 * that touched at rest. Its force is right, only the books are opened a step late. */
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
        /* largest displacement by vibration: sum |phi| sqrt(q^2 + v^2/omega^2) */
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

/* Whether the right-hand side is not smooth at a root: where a contact opens or closes, and where a
 * law may have yielded at a peak. */
static bool must_restart(const struct reference *run, const int *found)
{
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        for (size_t r = 0; r < run->system.roots; r++)
            if ((r == 0 || run->system.roots > 2) && found[run->system.roots * c + r])
                return true;
    return false;
}

/* Adds the moments of a step's impulses, at its middle: it is far shorter than a contact. */
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
    /* contacts under load yield up to here */
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
    /* the effort */
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
