/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/motion.h"

#include <string.h>

#include "impact/flight_kernel.h"
#include "impact/kernel.h"
#include "impact/oscillator.h"

bool motion_create(struct motion *motion, const struct scene *scene, struct arena *arena)
{
    /* pairs of arrays, one behind the other */
    motion->gap = arena_take(arena, 2 * scene->rows, sizeof *motion->gap);
    motion->q = arena_reserve(arena, 2 * scene->groups, sizeof *motion->q);
    if (!motion->gap || !motion->q)
        return false;
    motion->gap_rate = motion->gap + scene->rows;
    motion->v = motion->q + scene->groups;
    for (size_t g = 0; g < scene->groups; g++) {
        size_t stride = scene->group[g].stride; /* whole lanes: both are aligned */
        motion->q[g] = arena_take(arena, 2 * stride, sizeof **motion->q);
        if (!motion->q[g])
            return false;
        motion->v[g] = motion->q[g] + stride;
    }
    return true;
}

static void copy_or_clear(double *to, const double *from, size_t count)
{
    if (from)
        memcpy(to, from, count * sizeof *to);
    else
        memset(to, 0, count * sizeof *to);
}

void motion_start(struct motion *motion, const struct scene *scene)
{
    motion->time = 0.0;
    copy_or_clear(motion->gap, scene->gap, scene->rows);
    copy_or_clear(motion->gap_rate, scene->gap_rate, scene->rows);
    for (size_t g = 0; g < scene->groups; g++) {
        copy_or_clear(motion->q[g], scene->group[g].q, scene->group[g].stride);
        copy_or_clear(motion->v[g], scene->group[g].v, scene->group[g].stride);
    }
}

void motion_copy(struct motion *to, const struct motion *from, const struct scene *scene)
{
    to->time = from->time;
    copy_or_clear(to->gap, from->gap, scene->rows);
    copy_or_clear(to->gap_rate, from->gap_rate, scene->rows);
    for (size_t g = 0; g < scene->groups; g++) {
        copy_or_clear(to->q[g], from->q[g], scene->group[g].stride);
        copy_or_clear(to->v[g], from->v[g], scene->group[g].stride);
    }
}

/* Damping counts forward only, see motion_rewind. */
static double damping_towards(const struct scene_group *group, size_t mode, double time)
{
    return time < 0.0 ? 0.0 : group->set->damping[mode];
}

/* Whether flight_kernel_turn can move a group's modes over a time. */
static bool turns_at_once(const struct scene_group *group, double time)
{
    return time >= 0.0 && group->count > 0 &&
           group->set->omega[group->count - 1] * time <= FLIGHT_TURN_ANGLE;
}

static void move_gaps(struct motion *motion, const struct scene *scene, double time)
{
    motion->time += time;
    for (size_t c = 0; c < scene->rows; c++) {
        double a = scene->gap_acceleration[c];
        motion->gap[c] += time * (motion->gap_rate[c] + 0.5 * a * time);
        motion->gap_rate[c] += a * time;
    }
}

/* Mode by mode. */
static void move_modes(struct motion *motion, const struct scene *scene, size_t g, double time)
{
    const struct scene_group *group = &scene->group[g];
    for (size_t k = 0; k < group->count; k++)
        if (motion->q[g][k] != 0.0 || motion->v[g][k] != 0.0)
            oscillator_advance(group->set->omega[k], damping_towards(group, k, time), time,
                               &motion->q[g][k], &motion->v[g][k]);
}

static void move(struct motion *motion, const struct scene *scene, double time)
{
    move_gaps(motion, scene, time);
    for (size_t g = 0; g < scene->groups; g++)
        move_modes(motion, scene, g, time);
}

void motion_turn(struct motion *motion, const struct scene *scene, double time)
{
    move_gaps(motion, scene, time);
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        struct flight_modes modes = flight_modes_of(group, 0, motion->q[g], motion->v[g]);
        if (turns_at_once(group, time))
            flight_kernel_turn(&modes, time, motion->q[g], motion->v[g]);
        else
            move_modes(motion, scene, g, time);
    }
}

bool motion_turn_tables(const struct scene *scene, double time, struct arena *arena,
                        double **tables)
{
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        struct flight_modes modes = flight_modes_of(group, 0, NULL, NULL);
        tables[g] = NULL;
        if (!turns_at_once(group, time))
            continue;
        tables[g] = arena_reserve(arena, group->stride, TURN_TERMS * sizeof(double));
        if (!tables[g])
            return false;
        flight_kernel_table(&modes, time, tables[g]);
    }
    return true;
}

void motion_turn_by(struct motion *motion, const struct scene *scene, double time,
                    double *const *tables)
{
    move_gaps(motion, scene, time);
    for (size_t g = 0; g < scene->groups; g++) {
        struct flight_modes modes =
            flight_modes_of(&scene->group[g], 0, motion->q[g], motion->v[g]);
        if (tables[g])
            flight_kernel_step(tables[g], &modes, motion->q[g], motion->v[g]);
        else
            move_modes(motion, scene, g, time);
    }
}

void motion_advance(struct motion *motion, const struct scene *scene, double time)
{
    move(motion, scene, time);
}

void motion_rewind(struct motion *motion, const struct scene *scene, double time)
{
    move(motion, scene, -time);
}

void motion_step_gaps(struct motion *to, const struct motion *from, const struct scene *scene,
                      int level)
{
    double h = step_length(level);
    to->time = from->time + h;
    for (size_t c = 0; c < scene->rows; c++) {
        double a = scene->gap_acceleration[c];
        to->gap[c] = from->gap[c] + h * (from->gap_rate[c] + 0.5 * a * h);
        to->gap_rate[c] = from->gap_rate[c] + a * h;
    }
}

void motion_step(struct motion *to, const struct motion *from, const struct scene *scene, int level)
{
    motion_step_gaps(to, from, scene, level);
    for (size_t g = 0; g < scene->groups; g++)
        kernel_advance(scene->group[g].set->tables[level], scene->group[g].stride, from->q[g],
                       from->v[g], to->q[g], to->v[g]);
}

void motion_push_gaps(struct motion *end, const struct scene *scene, int level, size_t row,
                      const double force[NODES])
{
    double impulse;
    double travel;
    motion_integrate(force, step_length(level), &impulse, &travel);
    const double *w = scene->w + row * scene->rows; /* symmetric */
    for (size_t a = 0; a < scene->rows; a++)
        end->gap[a] += w[a] * travel;
    for (size_t a = 0; a < scene->rows; a++)
        end->gap_rate[a] += w[a] * impulse;
}

void motion_push(struct motion *end, const struct scene *scene, int level,
                 double (*const force)[NODES])
{
    for (size_t b = 0; b < scene->rows; b++) {
        if (!motion_bears(force[b]))
            continue;
        motion_push_gaps(end, scene, level, b, force[b]);
        for (size_t g = 0; g < scene->groups; g++) {
            const struct scene_group *group = &scene->group[g];
            if (group->participation[b])
                kernel_push(group->set->tables[level], group->stride, group->participation[b],
                            force[b], end->q[g], end->v[g]);
        }
    }
}

void motion_approach(const struct motion *motion, const struct scene *scene, size_t row,
                     double *approach, double *rate)
{
    double d = 0.0;
    double d_rate = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        double part;
        double part_rate;
        if (!group->participation[row])
            continue;
        kernel_dot2(group->stride, group->participation[row], motion->q[g], motion->v[g], &part,
                    &part_rate);
        d += part;
        d_rate += part_rate;
    }
    *approach = -motion->gap[row] - d;
    *rate = -motion->gap_rate[row] - d_rate;
}

void motion_approach_at(const struct motion *motion, const struct scene *scene, size_t row,
                        double time, double *approach, double *rate)
{
    double d = 0.0;
    double d_rate = 0.0;
    /* the modes at that instant */
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *phi = group->participation[row];
        for (size_t k = 0; phi && k < group->count; k++) {
            double q = motion->q[g][k];
            double v = motion->v[g][k];
            if (phi[k] == 0.0 || (q == 0.0 && v == 0.0))
                continue;
            oscillator_advance(group->set->omega[k], damping_towards(group, k, time), time, &q, &v);
            d += phi[k] * q;
            d_rate += phi[k] * v;
        }
    }
    /* with the rigid gap */
    double a = scene->gap_acceleration[row];
    *approach = -(motion->gap[row] + time * (motion->gap_rate[row] + 0.5 * a * time)) - d;
    *rate = -(motion->gap_rate[row] + a * time) - d_rate;
}

double motion_vibration(const struct motion *motion, const struct scene *scene, size_t body)
{
    double sum = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        if (group->body != body)
            continue;
        for (size_t k = 0; k < group->count; k++) {
            double spring = group->set->omega[k] * motion->q[g][k];
            sum += motion->v[g][k] * motion->v[g][k] + spring * spring;
        }
    }
    return 0.5 * sum;
}

double motion_free_loss(const struct motion *motion, const struct scene *scene, double time)
{
    double sum = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const struct flight_modes modes = flight_modes_of(group, 0, motion->q[g], motion->v[g]);
        if (!group->count || !modes.damping)
            continue;
        if (turns_at_once(group, time)) {
            sum += flight_kernel_loss(&modes, time);
            continue;
        }
        for (size_t k = 0; k < group->count; k++)
            sum += oscillator_free_loss(modes.omega[k], modes.damping[k], time, modes.q[k],
                                        modes.v[k]);
    }
    return sum;
}
