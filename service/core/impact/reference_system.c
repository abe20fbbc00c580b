/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/reference_system.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/impact_scale.h"
#include "numeric/linear.h"

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
size_t reference_damping_loss(const struct reference_system *system)
{
    return 3 * system->rows;
}

size_t reference_normal_work(const struct reference_system *system, size_t i)
{
    return 3 * system->rows + 1 + 2 * i;
}

size_t reference_lossy_work(const struct reference_system *system)
{
    return reference_normal_work(system, system->scene->frictions);
}

static size_t first_mode(const struct reference_system *system)
{
    size_t next = reference_lossy_work(system) + (system->followed ? 1 : 0);
    for (size_t c = 0; system->followed && c < system->scene->contacts; c++)
        if (system->followed[c].memory)
            next += memory_rates_size(system->followed[c].memory);
    return next;
}

/* False: out of memory. */
static bool follow_memory(struct reference_system *system, size_t c, struct arena *arena)
{
    const struct scene *scene = system->scene;
    struct followed *followed = &system->followed[c];
    followed->state = first_mode(system);
    struct memory_rates *memory = arena_take(arena, 1, sizeof *memory);
    if (!memory)
        return false;
    memory_rates_create(memory, &scene->laws[c], scene->residual[c * (scene->rows + 1)]);
    followed->rate = arena_take(arena, memory_rates_size(memory), sizeof(double));
    followed->memory = memory;
    system->remembers = true;
    return followed->rate != NULL;
}

/* What lossy laws add. False: out of memory. */
static bool followed_create(struct reference_system *system, struct arena *arena)
{
    const struct scene *scene = system->scene;
    if (!scene_is_lossy(scene))
        return true;
    system->followed = arena_take(arena, scene->contacts, sizeof *system->followed);
    if (!system->followed)
        return false;
    for (size_t c = 0; c < scene->contacts; c++)
        if (scene->laws[c].operations->remembers && !follow_memory(system, c, arena))
            return false;
    return true;
}

bool reference_system_create(struct reference_system *system, const struct scene *scene,
                             struct arena *arena)
{
    size_t n = scene->contacts;
    size_t rows = scene->rows;
    *system = (struct reference_system){.scene = scene, .rows = rows, .roots = 2};
    /* a third root function of laws that yield */
    for (size_t c = 0; c < n; c++)
        if (scene->laws[c].operations->curve || scene->laws[c].operations->remembers)
            system->roots = 3;
    if (!followed_create(system, arena))
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

void reference_system_unpack(const struct reference_system *system, const double *y,
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

void reference_system_pack(const struct reference_system *system, const struct motion *motion,
                           double *y)
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
bool reference_frictions_create(struct reference_system *system, double accuracy,
                                struct arena *arena)
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

void reference_friction_begin(struct reference_system *system, size_t i, double depth)
{
    struct friction *friction = &system->taken[i];
    double force[2];
    friction_touch(friction, &system->scene->laws[system->scene->friction[i].contact], depth);
    friction_walk(friction, 0.0, system->indentation + scene_tangent(system->scene, i), force);
    friction_copy(&system->trial[i], friction);
}

double reference_residual(const struct reference_system *system, size_t row, size_t first,
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
        system->pressed[c] = system->approach[c] - reference_residual(system, c, n, system->rows);
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
            d[t] - system->approach[row + t] + reference_residual(system, row + t, 0, system->rows);
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
        system->indentation[r] =
            system->approach[r] - reference_residual(system, r, 0, system->rows);
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

/* Newton's method for d + c F(d, rate) = approach of a contact, with the rate of the bodies'
 * approach (way_contact.h). */
static void press_moving(struct reference_system *system, size_t c, double approach)
{
    const struct contact_law *law = &system->scene->laws[c];
    struct followed *followed = &system->followed[c];
    double own = system->scene->residual[c * (system->rows + 1)], *d = &system->indentation[c];
    double viscosity;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        double *stiffness = &followed->stiffness;
        system->force[c] =
            law->operations->moving
                ? law->operations->moving(law, *d, system->rate[c], stiffness, &viscosity)
                : contact_law_force(law, *d, stiffness);
        double change = (*d + own * system->force[c] - approach) / (1.0 + own * *stiffness);
        *d -= change;
        if (fabs(change) <= SAME_FORCE * larger(fabs(approach), fabs(*d)))
            return;
    }
}

/* That of a law that remembers. */
static void press_memory(struct reference_system *system, size_t c, double approach, double t,
                         const double *y)
{
    struct followed *followed = &system->followed[c];
    struct memory_instant *at = &followed->present;
    *at = (struct memory_instant){
        .time = t, .approach = approach, .indentation = system->indentation[c]};
    memory_rates_find(followed->memory, y + followed->state, at, followed->rate);
    system->indentation[c] = at->indentation;
    system->force[c] = at->force;
    followed->stiffness = at->stiffness;
    followed->fades = at->fades;
}

/* Each contact under the others' forces, in turn. */
static void press_followed(struct reference_system *system, double t, const double *y)
{
    size_t n = system->scene->contacts;
    bool same = false;
    for (int round = 0; !same && round < MOST_ROUNDS; round++) {
        same = true;
        for (size_t c = 0; c < n; c++) {
            double own = system->scene->residual[c * (system->rows + 1)] * system->force[c];
            double approach = system->approach[c] - reference_residual(system, c, 0, n) + own;
            double before = system->indentation[c];
            if (system->followed[c].memory)
                press_memory(system, c, approach, t, y);
            else
                press_moving(system, c, approach);
            double change = fabs(system->indentation[c] - before);
            same = same && change <= SAME_FORCE * larger(fabs(approach), fabs(before));
        }
    }
}

/* Second derivative of the bodies' approach at a contact under the present forces. */
static double approach_acceleration(const struct reference_system *system, size_t c)
{
    const struct scene *scene = system->scene;
    double sum = -scene->gap_acceleration[c];
    for (size_t b = 0; b < scene->contacts; b++)
        sum -= scene->w[c * scene->rows + b] * system->force[b];
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        for (size_t k = 0; group->participation[c] && k < group->count; k++) {
            double omega = group->set->omega[k], damping = group->set->damping[k], push = 0.0;
            for (size_t b = 0; b < scene->contacts; b++)
                push +=
                    group->participation[b] ? group->participation[b][k] * system->force[b] : 0.0;
            sum -= group->participation[c][k] *
                   (push - omega * (2.0 * damping * system->motion.v[g][k] +
                                    omega * system->motion.q[g][k]));
        }
    }
    return sum;
}

/* Rates of the indentations, with the forces' rates F' = stiffness d' + fades:
 * d' + C F' = the approach's rate. */
static void find_turning(struct reference_system *system)
{
    const struct scene *scene = system->scene;
    size_t n = scene->contacts;
    double rate[PERCUSS_MAX_CONTACTS];
    for (size_t c = 0; c < n; c++) {
        const struct contact_law *law = &scene->laws[c];
        double ignored, viscosity;
        if (!law->operations->moving)
            continue;
        law->operations->moving(law, system->indentation[c], system->rate[c], &ignored, &viscosity);
        system->followed[c].fades = viscosity * approach_acceleration(system, c);
    }
    for (size_t a = 0; a < n; a++) {
        rate[a] = system->rate[a];
        for (size_t b = 0; b < n; b++) {
            double residual = scene->residual[a * scene->rows + b];
            rate[a] -= residual * system->followed[b].fades;
            system->matrix[a * n + b] = residual * system->followed[b].stiffness + (a == b);
        }
    }
    if (!linear_solve(n, system->matrix, rate))
        return;
    for (size_t c = 0; c < n; c++)
        system->followed[c].turning = rate[c] - system->followed[c].present.recedes;
}

void reference_system_forces(struct reference_system *system, double t, const double *y)
{
    reference_system_unpack(system, y, &system->motion);
    for (size_t r = 0; r < system->rows; r++)
        motion_approach(&system->motion, system->scene, r, &system->approach[r], &system->rate[r]);
    for (size_t c = 0; c < system->scene->contacts; c++)
        if (!(system->indentation[c] > 0.0))
            system->indentation[c] = fmax(0.0, system->approach[c]);
    if (system->scene->frictions)
        solve_rows(system);
    else if (system->followed)
        press_followed(system, t, y);
    else
        contact_local_indentation(system->scene, system->approach, system->indentation,
                                  system->force, system->matrix);
    if (system->remembers)
        find_turning(system);
}

/* The work on the approaches, and what is remembered. */
static void find_followed_rates(const struct reference_system *system, double *rate)
{
    double *work = &rate[reference_lossy_work(system)];
    *work = 0.0;
    for (size_t c = 0; c < system->scene->contacts; c++) {
        const struct followed *followed = &system->followed[c];
        *work += system->force[c] * system->rate[c];
        if (followed->memory)
            memcpy(rate + followed->state, followed->rate,
                   memory_rates_size(followed->memory) * sizeof *rate);
    }
}

void reference_system_rates(double t, const double *y, double *rate, void *context)
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
        rate[reference_normal_work(system, i)] = larger(-power, 0.0);
        rate[reference_normal_work(system, i) + 1] = larger(power, 0.0);
    }
    if (system->followed)
        find_followed_rates(system, rate);
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
    rate[reference_damping_loss(system)] = loss;
}

struct followed *reference_memory_of(const struct reference_system *system, size_t c)
{
    return system->followed && system->followed[c].memory ? &system->followed[c] : NULL;
}

void reference_system_roots(double t, const double *y, double *values, void *context)
{
    struct reference_system *system = context;
    reference_system_forces(system, t, y);
    for (size_t c = 0; c < system->scene->contacts; c++) {
        double *value = values + system->roots * c;
        const struct followed *followed = reference_memory_of(system, c);
        value[0] = system->indentation[c];
        value[1] = followed ? followed->turning : system->rate[c];
        if (followed)
            value[2] = followed->present.pressed;
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

void reference_system_tolerate(struct reference_system *system, const struct motion *motion,
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
    for (size_t i = reference_damping_loss(system); i < first_mode(system); i++)
        system->absolute[i] = relative * energy;
    for (size_t c = 0; c < n; c++)
        if (reference_memory_of(system, c))
            memory_rates_tolerate(system->followed[c].memory, relative,
                                  system->absolute[c] / relative,
                                  system->absolute + system->followed[c].state);
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
