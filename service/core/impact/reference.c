/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The independent reference: the whole scene as one system of ordinary differential equations,
 * solved by CVODE (Adams) with root finding. It shares the scene and the laws with the modal
 * method, and nothing of its time integration. */
#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/flight_root.h"
#include "impact/impact_scale.h"
#include "impact/march.h"
#include "impact/reference_system.h"
#include "numeric/ode.h"

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

/* Steps while a contact with friction is closed, over the duration of a collision with all the
 * energy: the way of a step is walked straight, which leaves an error of the second order in it. Of
 * twelve angles of a sphere (test_reference.c) the worst tangential speed is wrong by 0.3 of the
 * square, times the coefficient's speed: here by less than the accuracy. Longer than a hundredth
 * cells would not follow a reversal; below a tenth of a thousandth the cells' own error is left. */
static const double WALK = 1.0; /* times the root of the accuracy */
static const double LONGEST_WALK = 0.01;
static const double SHORTEST_WALK = 1e-4;

/* Passes over the modes in a step: right-hand sides, and the steps that CVODE remembers. */
static const double PASSES = 10.0;

struct reference {
    struct march march;
    struct reference_system system;
    double accuracy;
    struct ode *ode; /* NULL: not begun */
    double *y;
    double *opened; /* [row] impulse when the sub-impact began */
    double *noted;  /* [contact] impulse of which the moment is noted */
    double longest; /* step that misses no root, s; 0: any */
};

static bool reference_create(struct reference *run, struct arena *arena)
{
    if (!march_create(&run->march, arena) ||
        !reference_system_create(&run->system, &run->march.scene, arena) ||
        !reference_frictions_create(&run->system, run->accuracy, arena))
        return false;
    run->opened = arena_take(arena, run->system.rows, sizeof(double));
    run->noted = arena_take(arena, run->march.scene.contacts, sizeof(double));
    run->y = arena_take(arena, run->system.size, sizeof(double));
    return run->opened && run->noted && run->y;
}

/* The longest step while contacts are closed as they are now. False: CVODE refuses. */
static bool limit_steps(struct reference *run)
{
    const struct scene *scene = &run->march.scene;
    double longest = run->longest > 0.0 ? run->longest : INFINITY;
    double share = fmax(SHORTEST_WALK, fmin(LONGEST_WALK, WALK * sqrt(run->accuracy)));
    for (size_t i = 0; i < scene->frictions; i++) {
        size_t c = scene->friction[i].contact;
        if (run->march.closed[c])
            longest = smaller(longest, share * run->system.duration[c]);
    }
    return ode_set_longest_step(run->ode, isfinite(longest) ? longest : 0.0);
}

/* Indentation that a contact's cells are laid out for: by the fastest approach of all, as a group
 * backs it, and under twice the load of an acceleration that presses. */
static double expected_depth(const struct reference *run, size_t c)
{
    const struct scene *scene = &run->march.scene;
    const struct contact_law *law = &scene->laws[c];
    double fastest = 0.0;
    for (size_t i = 0; i < scene->contacts; i++)
        fastest = larger(fastest, fabs(run->system.rate[i]));
    double load = -2.0 * scene->gap_acceleration[c] / scene->w[c * (run->system.rows + 1)];
    double pressed = load > 0.0 ? law->operations->indentation(law, load) : 0.0;
    return larger(impact_scale_of(scene, c, fastest).indentation, pressed);
}

/* A sub-impact begins, of which the cells may have begun to bear. */
static void note_opening(struct reference *run, size_t c, double time)
{
    const struct scene *scene = &run->march.scene;
    size_t n = run->system.rows;
    size_t friction = scene_friction_of(scene, c);
    memcpy(run->march.outcome->motion.gap_rate, run->y + n, n * sizeof *run->y);
    run->opened[c] = run->y[2 * n + c];
    for (size_t t = 0; friction < scene->frictions && t < 2; t++) {
        size_t row = scene_tangent(scene, friction) + t;
        run->opened[row] = run->y[2 * n + row];
    }
    march_open(&run->march, c, time, run->y[n + c]);
}

static void open_contact(struct reference *run, size_t c, double t)
{
    size_t friction = scene_friction_of(&run->march.scene, c);
    run->system.indentation[c] = 0.0;
    if (friction < run->march.scene.frictions)
        reference_friction_begin(&run->system, friction, expected_depth(run, c));
    note_opening(run, c, t);
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
    track->open.compression_impulse = run->y[2 * run->system.rows + c] - run->opened[c];
}

static void note_impulse(struct reference *run, size_t c)
{
    const struct scene *scene = &run->march.scene;
    struct sub_impact *open = &run->march.outcome->tracks[c].open;
    const double *impulse = run->y + 2 * run->system.rows;
    size_t friction = scene_friction_of(scene, c);
    open->impulse = impulse[c] - run->opened[c];
    for (size_t t = 0; friction < scene->frictions && t < 2; t++) {
        size_t row = scene_tangent(scene, friction) + t;
        open->impulse_tangential[t] = impulse[row] - run->opened[row];
    }
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
    size_t friction = scene_friction_of(run->system.scene, c);
    if (friction < run->system.scene->frictions)
        friction_deepen(&run->system.taken[friction], deeper);
    outcome->tracks[c].deepened += deeper;
    /* as in the modal method, but the solution goes on */
    if (!contact_bears(&run->march.scene, c, contact_law_unloading(law)))
        outcome->too_stiff = true;
}

/* A contact that remembers turns, parts or touches, by its roots that are found. */
static void turn_memory(struct reference *run, size_t c, const int *found)
{
    struct reference_system *system = &run->system;
    struct followed *followed = reference_memory_of(system, c);
    bool shrinks = followed->memory->memory.shrinks;
    bool grows_again = shrinks && (found[1] > 0 || found[2] < 0);
    struct track *track = &run->march.outcome->tracks[c];
    if (shrinks && found[2] < 0) {
        followed->parted_at = followed->present.time;
        followed->parted_rate = run->y[system->rows + c];
    }
    if (found[2] > 0 && track->largest_force <= NO_FORCE * system->absolute_force[c])
        track->open.start = followed->present.time;
    if (grows_again || (!shrinks && found[1] < 0))
        memory_rates_meet(followed->memory, run->y + followed->state, &followed->present);
}

/* A contact ends whose indentation is 0 at `t`. */
static void close_contact(struct reference *run, size_t c, double t)
{
    const struct followed *followed = reference_memory_of(&run->system, c);
    double rate = run->y[run->system.rows + c];
    march_close(&run->march, c, followed ? followed->parted_at : t,
                followed ? followed->parted_rate : rate);
}

/* Bookkeeping at a root: contacts open and close, indentations peak. */
static void handle_roots(struct reference *run, double t, const int *found)
{
    struct march *march = &run->march;
    size_t n = march->scene.contacts, rows = run->system.rows;
    /* contacts that open and close */
    for (size_t c = 0; c < n; c++) {
        int opens = found[run->system.roots * c];
        if (opens > 0 && !march->closed[c]) {
            open_contact(run, c, t);
        } else if (opens < 0 && march->closed[c]) {
            note_impulse(run, c);
            memcpy(march->outcome->motion.gap_rate, run->y + rows, rows * sizeof *run->y);
            close_contact(run, c, t);
        }
    }
    /* indentations at their largest: a law may yield there */
    reference_system_forces(&run->system, run->march.outcome->motion.time, run->y);
    for (size_t c = 0; c < n; c++) {
        if (!march->closed[c] || found[run->system.roots * c + 1] >= 0)
            continue;
        note_largest(run, c, t);
        yield(run, c);
    }
    for (size_t c = 0; c < n; c++)
        if (reference_memory_of(&run->system, c))
            turn_memory(run, c, found + run->system.roots * c);
}

/* CVODE does not report the rise of a root function that was exactly zero at a start: a contact
 * that touched at rest. Its force is right, only the books are opened a step late. */
static void open_unreported(struct reference *run, double t)
{
    reference_system_forces(&run->system, run->march.outcome->motion.time, run->y);
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        if (!run->march.closed[c] && run->system.force[c] > 0.0 &&
            run->system.force[c] > NO_FORCE * run->system.absolute_force[c])
            note_opening(run, c, t);
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
    size_t rows = run->system.rows;
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        double impulse = run->y[2 * rows + c] - run->noted[c];
        run->march.outcome->tracks[c].moment += 0.5 * (before + now) * impulse;
        run->noted[c] += impulse;
    }
}

/* A step has been accepted: the cells have come to its end, where they stick or slide. */
static void take_walk(struct reference *run)
{
    struct reference_system *system = &run->system;
    reference_system_forces(system, run->march.outcome->motion.time, run->y);
    for (size_t i = 0; i < system->scene->frictions; i++) {
        size_t c = system->scene->friction[i].contact;
        struct track *track = &run->march.outcome->tracks[c];
        bool bears = system->force[c] > NO_FORCE * system->absolute_force[c];
        friction_copy(&system->taken[i], &system->trial[i]);
        if (!run->march.closed[c] || !bears)
            continue;
        track->stuck = track->stuck || system->trial[i].stuck > 0.0;
        track->slid = track->slid || system->trial[i].stuck == 0.0;
    }
}

/* The largest forces of lossy laws, at the steps. */
static void note_forces(struct reference *run)
{
    reference_system_forces(&run->system, run->march.outcome->motion.time, run->y);
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        struct track *track = &run->march.outcome->tracks[c];
        if (run->march.closed[c] && run->march.scene.laws[c].operations->lossy)
            track->largest_force = larger(track->largest_force, run->system.force[c]);
    }
}

/* At the horizon: contacts that remember may have parted. */
static enum percuss_end_reason end_at_horizon(struct reference *run)
{
    struct march *march = &run->march;
    if (!march_in_contact(march))
        return PERCUSS_END_HORIZON;
    for (size_t c = 0; c < march->scene.contacts; c++) {
        if (!march->closed[c] || !reference_memory_of(&run->system, c) ||
            run->system.force[c] > 0.0)
            continue;
        note_impulse(run, c);
        close_contact(run, c, march->horizon);
    }
    if (march_in_contact(march))
        return PERCUSS_END_IN_CONTACT;
    return march->scene.groups > 0 ? PERCUSS_END_HORIZON : march_parted(march);
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
        if (march->scene.frictions)
            take_walk(run);
        if (run->system.followed)
            note_forces(run);
        /* contacts and laws that change, from which the solver starts anew */
        if (event == ODE_ROOT) {
            handle_roots(run, *now, found);
            if (must_restart(run, found) && !ode_set(run->ode, *now, run->y))
                return PERCUSS_END_LIMIT;
        }
        if (event == ODE_STEP)
            open_unreported(run, *now);
        if (march->scene.frictions && !limit_steps(run))
            return PERCUSS_END_LIMIT;
        /* the end of the window, or no touch can follow */
        bool closed = march_in_contact(march);
        if (event == ODE_REACHED)
            return end_at_horizon(run);
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
    /* contacts that touch at the start, and cells of all that may without a root */
    for (size_t r = 0; r < run->system.rows; r++)
        motion_approach(motion, scene, r, &run->system.approach[r], &run->system.rate[r]);
    for (size_t r = scene->contacts; r < run->system.rows; r++)
        run->system.indentation[r] = run->system.approach[r];
    for (size_t i = 0; i < scene->frictions; i++)
        reference_friction_begin(&run->system, i, expected_depth(run, scene->friction[i].contact));
    for (size_t c = 0; c < scene->contacts; c++) {
        double near = TOUCHING * impact_scale_of(scene, c, run->system.rate[c]).indentation;
        if (run->system.approach[c] >= -near && run->system.rate[c] > 0.0)
            open_contact(run, c, motion->time);
    }
    /* from there on, in steps that miss no root */
    double fastest = scene_highest_frequency(scene);
    run->longest = fastest > 0.0 ? LONGEST_ANGLE / fastest : 0.0;
    bool ready = ode_set(run->ode, motion->time, run->y) && limit_steps(run);
    return ready ? integrate(run) : PERCUSS_END_LIMIT;
}

/* Loss and store of the friction, the tangents' forces, and the normal works. */
static void end_friction(struct reference *run)
{
    const struct scene *scene = &run->march.scene;
    struct impact_outcome *outcome = run->march.outcome;
    for (size_t i = 0; i < scene->frictions; i++) {
        const struct friction *taken = &run->system.taken[i];
        size_t c = scene->friction[i].contact;
        const double *work = run->y + reference_normal_work(&run->system, i);
        outcome->tracks[c].compressed = work[0];
        outcome->tracks[c].released = work[1];
        outcome->slid += taken->lost;
        if (!run->march.closed[c])
            continue;
        outcome->sheared += friction_stored(taken);
        friction_force(taken, run->march.tangential + 2 * i);
    }
}

/* The work on the approaches less what flexibility and laws give back, and what dents take. */
static void end_lossy(struct reference *run)
{
    const struct reference_system *system = &run->system;
    const struct scene *scene = system->scene;
    double sum = run->y[reference_lossy_work(system)] - run->march.outcome->plastic;
    for (size_t c = 0; c < scene->contacts; c++) {
        const struct contact_law *law = &scene->laws[c];
        sum -= 0.5 * system->force[c] * reference_residual(system, c, 0, scene->contacts);
        sum -= law->operations->stored(law, run->march.indentation[c]);
    }
    run->march.outcome->relaxed = sum;
    run->march.force = system->force;
}

static void end_march(void *state)
{
    struct reference *run = state;
    struct march *march = &run->march;
    if (!run->ode)
        return;
    /* contacts under load yield up to here */
    reference_system_forces(&run->system, run->march.outcome->motion.time, run->y);
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
    march->damping = run->y[reference_damping_loss(&run->system)];
    end_friction(run);
    if (run->system.followed)
        end_lossy(run);
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
    for (size_t c = 0; c < scene->contacts; c++)
        if (contact_law_refuses(&scene->laws[c], scene->frictions))
            return PERCUSS_INTERNAL;
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
