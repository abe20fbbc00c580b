/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/reference_system.h"

#include <math.h>
#include <string.h>

#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/impact_scale.h"

/* A root function must be finite; no contact indents by so much, m. */
static const double ENDLESS = 1e3;

/* Tolerances must not be 0: of bodies at rest, J. */
static const double LEAST_ENERGY = 1e-300;

static size_t oscillator_count(const struct scene *scene)
{
    size_t count = 0;
    for (size_t g = 0; g < scene->groups; g++)
        count += scene->group[g].count;
    return count;
}

bool reference_system_create(struct reference_system *system, const struct scene *scene,
                             struct arena *arena)
{
    size_t n = scene->contacts;
    *system = (struct reference_system){.scene = scene, .roots = 2};
    /* laws that yield have a root function more */
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

void reference_system_unpack(const struct reference_system *system, const double *y,
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

void reference_system_pack(const struct reference_system *system, const struct motion *motion,
                           double *y)
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

void reference_system_forces(struct reference_system *system, const double *y)
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

void reference_system_rates(double t, const double *y, double *rate, void *context)
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
    /* modes q'' = sum_c phi_c F_c - 2 zeta omega q' - omega^2 q, and what damping takes */
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

void reference_system_roots(double t, const double *y, double *values, void *context)
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

void reference_system_tolerate(struct reference_system *system, const struct motion *motion,
                               double relative)
{
    const struct scene *scene = system->scene;
    size_t n = scene->contacts;
    /* the energy at hand: of the approaches and of vibration */
    double energy = LEAST_ENERGY;
    for (size_t c = 0; c < n; c++) {
        double v = scene->gap_rate[c];
        energy += 0.5 * v * v / scene->w[c * n + c];
    }
    for (size_t g = 0; g < scene->groups; g++)
        for (size_t b = 0; b < scene->bodies; b++)
            energy += motion_vibration(motion, scene, b) / (double)scene->groups;
    /* a contact with all of it: force, gap, rate and impulse */
    for (size_t c = 0; c < n; c++) {
        double v = sqrt(2.0 * energy * scene->w[c * n + c]);
        struct impact_scale scale = impact_scale_of(scene, c, v);
        system->absolute_force[c] = scale.force;
        system->absolute[c] = relative * scale.indentation;
        system->absolute[n + c] = relative * v;
        system->absolute[2 * n + c] = relative * v / scene->w[c * n + c];
    }
    system->absolute[3 * n] = relative * energy;
    /* a mode with all of it */
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
