/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The independent reference: the whole scene as one system of ordinary differential equations,
 * solved by CVODE (Adams) with root finding. It shares the scene and the laws with the modal
 * method, and nothing of its time integration. */
#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "contact/friction.h"
#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/flight_root.h"
#include "impact/impact_scale.h"
#include "impact/march.h"
#include "impact/memory_rates.h"
#include "impact/motion.h"
#include "numeric/ode.h"

/* ---- The system for CVODE ---- */

/* A whole scene as one system of ordinary differential equations, for a general solver.
 *
 * y: [rows] gaps, [rows] gap rates, [rows] impulses, 1 damping loss, of each contact with friction
 * its normal work in compression and in release, of a lossy law the work on the approach and its
 * memory, then every group's q and v. Root functions: per
 * contact the local indentation, the approach rate and, where a law yields, the indentation beyond
 * the elastic limit.
 *
 * Friction depends on the way: its force in a state is that of the cells walked from the last step
 * that was accepted to there, straight, which is a continuous function of the state. An accepted
 * step takes the walk to its end for good. */
struct reference_system {
    const struct scene *scene;
    size_t rows;
    size_t roots;                                           /* root functions of a contact */
    size_t size;                                            /* of y */
    struct motion motion;                                   /* a state unpacked */
    double *approach, *rate, *indentation, *force, *matrix; /* [row], local; matrix: contacts^2 */
    double *absolute;                                       /* [size] absolute tolerances */
    double *absolute_force;        /* [contact] of a collision with all the energy, N */
    double *duration;              /* [contact] of such a collision, s */
    double *pressed;               /* [contact] approaches less the tangents' effect */
    struct friction *taken;        /* [frictions]: histories up to the last accepted step */
    struct friction *trial;        /* [frictions]: to the state of the last evaluation */
    bool lossy;                    /* the only contact's law */
    struct memory_rates *memory;   /* where it remembers, else NULL */
    struct memory_instant present; /* of that, */
    double *memory_rate;           /* and the rates of its state */
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

/* Places in y: the damping loss, the works of friction `i`'s contact, of a lossy law, the
 * modes. */
static size_t damping_loss(const struct reference_system *system)
{
    return 3 * system->rows;
}

static size_t normal_work(const struct reference_system *system, size_t i)
{
    return 3 * system->rows + 1 + 2 * i;
}

/* Its memory is behind it. */
static size_t lossy_work(const struct reference_system *system)
{
    return normal_work(system, system->scene->frictions);
}

static size_t first_mode(const struct reference_system *system)
{
    size_t memory = system->memory ? memory_rates_size(system->memory) : 0;
    return lossy_work(system) + (system->lossy ? 1 + memory : 0);
}

/* What a lossy law adds. False: out of memory. */
static bool lossy_create(struct reference_system *system, struct arena *arena)
{
    const struct contact_law *law = &system->scene->laws[0];
    system->lossy = law->operations->lossy;
    if (!law->operations->remembers)
        return true;
    system->memory = arena_take(arena, 1, sizeof *system->memory);
    if (!system->memory)
        return false;
    memory_rates_create(system->memory, law, system->scene->residual[0]);
    system->memory_rate = arena_take(arena, memory_rates_size(system->memory), sizeof(double));
    return system->memory_rate != NULL;
}

/* False: out of memory. */
static bool reference_system_create(struct reference_system *system, const struct scene *scene,
                                    struct arena *arena)
{
    size_t n = scene->contacts;
    size_t rows = scene->rows;
    *system = (struct reference_system){.scene = scene, .rows = rows, .roots = 2};
    /* a third root function of laws that yield */
    for (size_t c = 0; c < n; c++)
        if (scene->laws[c].operations->curve || scene->laws[c].operations->remembers)
            system->roots = 3;
    if (!lossy_create(system, arena))
        return false;
    /* gaps, their rates, impulses, the loss, works and the modes */
    system->size = first_mode(system) + 2 * oscillator_count(scene);
    system->approach = arena_take(arena, rows, sizeof(double));
    system->rate = arena_take(arena, rows, sizeof(double));
    system->indentation = arena_take(arena, rows, sizeof(double));
    system->force = arena_take(arena, rows, sizeof(double));
    system->absolute_force = arena_take(arena, n, sizeof(double));
    system->duration = arena_take(arena, n, sizeof(double));
    system->pressed = arena_take(arena, n, sizeof(double));
    system->matrix = arena_take(arena, n * n, sizeof(double));
    system->absolute = arena_take(arena, system->size, sizeof(double));
    return system->approach && system->rate && system->indentation && system->force &&
           system->absolute_force && system->duration && system->pressed && system->matrix &&
           system->absolute && motion_create(&system->motion, scene, arena);
}

static void reference_system_unpack(const struct reference_system *system, const double *y,
                                    struct motion *motion)
{
    size_t n = system->rows;
    memcpy(motion->gap, y, n * sizeof *y);
    memcpy(motion->gap_rate, y + n, n * sizeof *y);
    const double *next = y + first_mode(system);
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
    size_t n = system->rows;
    memset(y, 0, system->size * sizeof *y);
    memcpy(y, motion->gap, n * sizeof *y);
    memcpy(y + n, motion->gap_rate, n * sizeof *y);
    double *next = y + first_mode(system);
    for (size_t g = 0; g < system->scene->groups; g++) {
        size_t count = system->scene->group[g].count;
        memcpy(next, motion->q[g], count * sizeof *y);
        memcpy(next + count, motion->v[g], count * sizeof *y);
        next += 2 * count;
    }
}

/* ---- Friction ---- */

/* Twice the cells of the modal method (friction_step.c), whose error goes with their inverse
 * square: the two methods do not share it. */
static const double CELLS = 8.0;
enum { FEWEST_CELLS = 64, MOST_CELLS = 512 };

/* False: out of memory. */
static bool frictions_create(struct reference_system *system, double accuracy, struct arena *arena)
{
    const struct scene *scene = system->scene;
    size_t n = scene->frictions;
    double cells = fmin(fmax(CELLS * pow(accuracy, -0.25), FEWEST_CELLS), MOST_CELLS);
    if (n == 0)
        return true;
    system->taken = arena_take(arena, 2 * n, sizeof *system->taken);
    if (!system->taken)
        return false;
    system->trial = system->taken + n;
    for (size_t i = 0; i < n; i++) {
        const struct scene_friction *of = &scene->friction[i];
        if (!friction_create(&system->taken[i], of->coefficient, of->ratio, (size_t)cells, arena) ||
            !friction_second(&system->trial[i], &system->taken[i], arena))
            return false;
    }
    return true;
}

/* The cells of friction `i`, all open, at the present displacement. */
static void friction_begin(struct reference_system *system, size_t i, double depth)
{
    struct friction *friction = &system->taken[i];
    double force[2];
    friction_touch(friction, &system->scene->laws[system->scene->friction[i].contact], depth);
    friction_walk(friction, 0.0, system->indentation + scene_tangent(system->scene, i), force);
    friction_copy(&system->trial[i], friction);
}

/* Reduction of a row's approach by the residual flexibility under the rows from `first` to `end`.
 */
static double residual_of(const struct reference_system *system, size_t row, size_t first,
                          size_t end)
{
    const double *by = system->scene->residual + row * system->rows; /* symmetric */
    double sum = 0.0;
    for (size_t r = first; r < end; r++)
        sum += by[r] * system->force[r];
    return sum;
}

/* Rounds of normals and tangents in turn end with a change of the tangential forces by this share
 * of their limit, or go on as far as rounding lets them. */
static const double SAME_FORCE = 1e-13;
enum { MOST_ROUNDS = 40 };

/* Normals under the tangents' forces. */
static void press_normals(struct reference_system *system)
{
    size_t n = system->scene->contacts;
    for (size_t c = 0; c < n; c++)
        system->pressed[c] = system->approach[c] - residual_of(system, c, n, system->rows);
    contact_local_indentation(system->scene, system->pressed, system->indentation, system->force,
                              system->matrix);
}

/* Walks friction `i` to the local displacements, then Newton's method for each of them by itself,
 * with the slope of the cells. Returns the change of the force over its limit. */
static double drag_tangents(struct reference_system *system, size_t i)
{
    const struct scene *scene = system->scene;
    const struct scene_friction *of = &scene->friction[i];
    struct friction *trial = &system->trial[i];
    size_t row = scene_tangent(scene, i);
    double *d = system->indentation + row;
    double limit = of->coefficient * system->force[of->contact];
    double change = 0.0;
    friction_copy(trial, &system->taken[i]);
    friction_walk(trial, system->indentation[of->contact], d, system->force + row);
    for (size_t t = 0; t < 2; t++) {
        double own = scene->residual[(row + t) * (system->rows + 1)];
        double excess =
            d[t] - system->approach[row + t] + residual_of(system, row + t, 0, system->rows);
        double moved = excess / (1.0 + own * trial->resists[t]);
        d[t] -= moved;
        change = fmax(change, fabs(moved) * trial->resists[t]);
    }
    return limit > 0.0 ? change / limit : 0.0;
}

/* Local indentations, displacements and forces of all rows for their approaches. */
static void solve_rows(struct reference_system *system)
{
    size_t n = system->scene->contacts;
    for (size_t r = n; r < system->rows; r++)
        system->indentation[r] = system->approach[r] - residual_of(system, r, 0, system->rows);
    for (int round = 0; round < MOST_ROUNDS; round++) {
        double pressed = 0.0, change = 0.0;
        double before[PERCUSS_MAX_CONTACTS];
        memcpy(before, system->force, n * sizeof *before);
        press_normals(system);
        for (size_t c = 0; round > 0 && c < n; c++)
            if (system->force[c] > 0.0)
                pressed = fmax(pressed, fabs(system->force[c] / before[c] - 1.0));
        for (size_t i = 0; i < system->scene->frictions; i++)
            change = fmax(change, drag_tangents(system, i));
        if (change <= SAME_FORCE && pressed <= SAME_FORCE)
            return;
    }
}

/* ---- Right-hand side ---- */

/* Newton's method for d + c F(d, rate) = approach of a law that has the approach's rate in it
 * (way_step.h). */
static void press_moving(struct reference_system *system)
{
    const struct contact_law *law = &system->scene->laws[0];
    double c = system->scene->residual[0], *d = system->indentation;
    double reach = fabs(*system->approach);
    for (int round = 0; round < MOST_ROUNDS; round++) {
        double stiffness, viscosity;
        *system->force = law->operations->moving(law, *d, *system->rate, &stiffness, &viscosity);
        double change = (*d + c * *system->force - *system->approach) / (1.0 + c * stiffness);
        *d -= change;
        if (fabs(change) <= SAME_FORCE * larger(reach, fabs(*d)))
            return;
    }
}

/* That of a law that remembers. */
static void press_memory(struct reference_system *system, double t, const double *y)
{
    struct memory_instant *at = &system->present;
    *at = (struct memory_instant){.time = t,
                                  .approach = *system->approach,
                                  .approach_rate = *system->rate,
                                  .indentation = *system->indentation};
    memory_rates_find(system->memory, y + lossy_work(system) + 1, at, system->memory_rate);
    *system->indentation = at->indentation;
    *system->force = at->force;
}

/* Finds motion, approaches, local indentations and forces of a state. */
static void reference_system_forces(struct reference_system *system, double t, const double *y)
{
    reference_system_unpack(system, y, &system->motion);
    for (size_t r = 0; r < system->rows; r++)
        motion_approach(&system->motion, system->scene, r, &system->approach[r], &system->rate[r]);
    for (size_t c = 0; c < system->scene->contacts; c++)
        if (!(system->indentation[c] > 0.0))
            system->indentation[c] = fmax(0.0, system->approach[c]);
    if (system->scene->frictions)
        solve_rows(system);
    else if (system->memory)
        press_memory(system, t, y);
    else if (system->lossy)
        press_moving(system);
    else
        contact_local_indentation(system->scene, system->approach, system->indentation,
                                  system->force, system->matrix);
}

/* dy/dt and the root functions, see ode.h; `context`: the system. */
static void reference_system_rates(double t, const double *y, double *rate, void *context)
{
    struct reference_system *system = context;
    const struct scene *scene = system->scene;
    size_t n = system->rows;
    reference_system_forces(system, t, y);
    /* gaps g'' = a + W F, impulses J' = F */
    for (size_t i = 0; i < n; i++) {
        rate[i] = y[n + i];
        rate[n + i] = scene->gap_acceleration[i];
        for (size_t j = 0; j < n; j++)
            rate[n + i] += scene->w[i * n + j] * system->force[j];
        rate[2 * n + i] = system->force[i];
    }
    for (size_t i = 0; i < scene->frictions; i++) {
        size_t c = scene->friction[i].contact;
        double power = system->force[c] * y[n + c];
        rate[normal_work(system, i)] = larger(-power, 0.0);
        rate[normal_work(system, i) + 1] = larger(power, 0.0);
    }
    if (system->lossy)
        rate[lossy_work(system)] = *system->force * *system->rate;
    if (system->memory)
        memcpy(rate + lossy_work(system) + 1, system->memory_rate,
               memory_rates_size(system->memory) * sizeof *rate);
    /* modes q'' = sum_c phi_c F_c - 2 zeta omega q' - omega^2 q, and the damping loss */
    double loss = 0.0;
    double *next = rate + first_mode(system);
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
    rate[damping_loss(system)] = loss;
}

static void reference_system_roots(double t, const double *y, double *values, void *context)
{
    struct reference_system *system = context;
    reference_system_forces(system, t, y);
    for (size_t c = 0; c < system->scene->contacts; c++) {
        double *value = values + system->roots * c;
        value[0] = system->indentation[c];
        value[1] = system->memory ? system->present.turning : system->rate[c];
        if (system->memory)
            value[2] = system->present.pressed;
        else if (system->roots > 2)
            value[2] =
                system->indentation[c] - fmin(contact_law_limit(&system->scene->laws[c]), ENDLESS);
    }
}

/* The inverse mass that a row's tolerances are made of: its own, or of a tangent along which the
 * bodies do not move rigidly that of its contact's normal. */
static double tolerated_mass(const struct scene *scene, size_t row)
{
    size_t rows = scene->rows;
    double w = scene->w[row * (rows + 1)];
    if (w > 0.0 || row < scene->contacts)
        return w;
    return scene->w[scene->friction[(row - scene->contacts) / 2].contact * (rows + 1)];
}

/* Gap, rate and impulse of a row with all the energy. */
static void tolerate_row(struct reference_system *system, size_t row, double relative,
                         double energy, double travel)
{
    size_t n = system->rows;
    double w = tolerated_mass(system->scene, row);
    double v = sqrt(2.0 * energy * w);
    system->absolute[row] = relative * travel;
    system->absolute[n + row] = relative * v;
    system->absolute[2 * n + row] = relative * v / w;
}

/* Sets the absolute tolerances from the energy of a motion, so that they are independent of
 * units. */
static void reference_system_tolerate(struct reference_system *system, const struct motion *motion,
                                      double relative)
{
    const struct scene *scene = system->scene;
    size_t n = scene->contacts;
    size_t rows = system->rows;
    /* the energy of the approaches and of vibration */
    double energy = LEAST_ENERGY;
    for (size_t r = 0; r < rows; r++) {
        double v = scene->gap_rate[r];
        energy += 0.5 * v * v / tolerated_mass(scene, r);
    }
    for (size_t g = 0; g < scene->groups; g++)
        for (size_t b = 0; b < scene->bodies; b++)
            energy += motion_vibration(motion, scene, b) / (double)scene->groups;
    /* a contact with all the energy: force, gap, rate and impulse */
    for (size_t c = 0; c < n; c++) {
        double v = sqrt(2.0 * energy * scene->w[c * (rows + 1)]);
        struct impact_scale scale = impact_scale_of(scene, c, v);
        system->absolute_force[c] = scale.force;
        system->duration[c] = scale.duration;
        tolerate_row(system, c, relative, energy, scale.indentation);
    }
    /* its tangents slip by about the coefficient's share of the indentation */
    for (size_t i = 0; i < 2 * scene->frictions; i++) {
        const struct scene_friction *of = &scene->friction[i / 2];
        double indentation = system->absolute[of->contact] / relative;
        tolerate_row(system, n + i, relative, energy, fmin(of->coefficient, 1.0) * indentation);
    }
    for (size_t i = damping_loss(system); i < first_mode(system); i++)
        system->absolute[i] = relative * energy;
    if (system->memory)
        memory_rates_tolerate(system->memory, relative, system->absolute[0] / relative,
                              system->absolute + lossy_work(system) + 1);
    /* a mode with all the energy */
    double *next = system->absolute + first_mode(system);
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
    double *opened;   /* [row] impulse when the sub-impact began */
    double *noted;    /* [contact] impulse of which the moment is noted */
    double longest;   /* step that misses no root, s; 0: any */
    double parted_at; /* of a contact that remembers, s */
};

static bool reference_create(struct reference *run, struct arena *arena)
{
    if (!march_create(&run->march, arena) ||
        !reference_system_create(&run->system, &run->march.scene, arena) ||
        !frictions_create(&run->system, run->accuracy, arena))
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
        friction_begin(&run->system, friction, expected_depth(run, c));
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

/* A contact that remembers turns, parts or touches. */
static void turn_memory(struct reference *run, const int *found)
{
    struct reference_system *system = &run->system;
    bool shrinks = system->memory->memory.shrinks;
    bool grows_again = shrinks && (found[1] > 0 || found[2] < 0);
    struct track *track = &run->march.outcome->tracks[0];
    if (shrinks && found[2] < 0)
        run->parted_at = system->present.time;
    if (found[2] > 0 && track->largest_force <= NO_FORCE * *system->absolute_force)
        track->open.start = system->present.time;
    if (grows_again || (!shrinks && found[1] < 0))
        memory_rates_meet(system->memory, run->y + lossy_work(system) + 1, &system->present);
}

/* The instant at which a contact ended whose indentation is 0 at `t`. */
static double end_of(const struct reference *run, double t)
{
    return run->system.memory ? run->parted_at : t;
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
            march_close(march, c, end_of(run, t), run->y[rows + c]);
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
    if (run->system.memory)
        turn_memory(run, found);
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

/* The largest force of a lossy law, at the steps. */
static void note_force(struct reference *run)
{
    struct track *track = &run->march.outcome->tracks[0];
    reference_system_forces(&run->system, run->march.outcome->motion.time, run->y);
    if (run->march.closed[0])
        track->largest_force = larger(track->largest_force, run->system.force[0]);
}

/* At the horizon: a contact that remembers may have parted. */
static enum percuss_end_reason end_at_horizon(struct reference *run)
{
    struct march *march = &run->march;
    bool parted = run->system.memory && !(run->system.force[0] > 0.0);
    if (!march_in_contact(march))
        return PERCUSS_END_HORIZON;
    if (!parted)
        return PERCUSS_END_IN_CONTACT;
    note_impulse(run, 0);
    march_close(march, 0, run->parted_at, run->y[run->system.rows]);
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
        if (run->system.lossy)
            note_force(run);
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
        friction_begin(&run->system, i, expected_depth(run, scene->friction[i].contact));
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
        const double *work = run->y + normal_work(&run->system, i);
        outcome->tracks[c].compressed = work[0];
        outcome->tracks[c].released = work[1];
        outcome->slid += taken->lost;
        if (!run->march.closed[c])
            continue;
        outcome->sheared += friction_stored(taken);
        friction_force(taken, run->march.tangential + 2 * i);
    }
}

/* The work on the approach less what series compliance and law give back. */
static void end_lossy(struct reference *run)
{
    const struct reference_system *system = &run->system;
    const struct contact_law *law = &system->scene->laws[0];
    double force = system->force[0];
    run->march.outcome->relaxed = run->y[lossy_work(system)] -
                                  0.5 * system->scene->residual[0] * force * force -
                                  law->operations->stored(law, run->march.indentation[0]);
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
    march->damping = run->y[damping_loss(&run->system)];
    end_friction(run);
    if (run->system.lossy)
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
