/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/midpoint.h"

#include <string.h>

#include "impact/kernel.h"

/* No step has been entered. */
enum { NO_STEP = -1 };

bool midpoint_create(struct midpoint *midpoint, const struct scene *scene, struct arena *arena)
{
    *midpoint = (struct midpoint){.level = NO_STEP};
    /* pairs of consecutive arrays */
    midpoint->q = arena_reserve(arena, 2 * scene->groups, sizeof *midpoint->q);
    if (!midpoint->q)
        return false;
    midpoint->v = midpoint->q + scene->groups;
    for (size_t g = 0; g < scene->groups; g++) {
        midpoint->damped = midpoint->damped || scene->group[g].set->most_damping > 0.0;
        size_t stride = scene->group[g].stride; /* whole lanes: both are aligned */
        midpoint->q[g] = arena_reserve(arena, 2 * stride, sizeof **midpoint->q);
        if (!midpoint->q[g])
            return false;
        midpoint->v[g] = midpoint->q[g] + stride;
    }
    return true;
}

/* The middle's table; NULL: damped. */
static const double *middle_of(const struct scene_group *group, int level)
{
    return group->set->tables[level]->middle;
}

/* Turn from a step's middle to the next one's. False: their lengths differ too much. */
static bool find_turn(int level, int next, enum middle_term *turn)
{
    static const enum middle_term turns[] = {TURN_LONGER, TURN_WHOLE, TURN_SHORTER};
    int change = next - level;
    if (change < -1 || change > 1)
        return false;
    *turn = turns[change + 1];
    return true;
}

/* Applies the forces of the taken step. */
static void kick(const struct midpoint *midpoint, const struct scene *scene,
                 const struct scene_group *group, double *const state[2])
{
    const double *middle = middle_of(group, midpoint->level);
    for (size_t c = 0; c < scene->rows; c++)
        if (group->participation[c] && motion_bears(midpoint->force[c]))
            kernel_kick(middle, group->stride, group->participation[c], midpoint->force[c], state);
}

/* Turns undamped modes from their instant to the middle of the step of `level`. */
static void turn_to(const struct midpoint *midpoint, const struct scene_group *group,
                    const double *const start[2], int level, double *const state[2])
{
    const double *const here[2] = {state[0], state[1]};
    const double *from = midpoint->level < 0 ? NULL : middle_of(group, midpoint->level);
    /* to the last step's end, or back to its start if it was not taken */
    if (from)
        kernel_turn(from, TURN_HALF, midpoint->force ? 1.0 : -1.0, group->stride, here, state);
    kernel_turn(middle_of(group, level), TURN_HALF, 1.0, group->stride, from ? here : start, state);
}

/* Moves a group's undamped modes to a step of `level`, pass by pass. */
static void enter(const struct midpoint *midpoint, const struct scene *scene, size_t g,
                  const double *const start[2], int level, double (*sums)[STEP_POINTS])
{
    const struct scene_group *group = &scene->group[g];
    double *const state[2] = {midpoint->q[g], midpoint->v[g]};
    if (midpoint->force)
        kick(midpoint, scene, group, state);
    turn_to(midpoint, group, start, level, state);
    for (size_t c = 0; c < scene->rows; c++)
        if (group->participation[c])
            kernel_swing(middle_of(group, level), group->stride, group->participation[c],
                         (const double *const[]){state[0], state[1]}, sums[c]);
}

/* Chooses the row for the pass that includes the turn: one that moves the group, and bears a
 * force if any such does. NONE: no row moves it. */
enum { NONE = SCENE_MOST_ROWS };
static size_t choose_one(const struct midpoint *midpoint, const struct scene *scene,
                         const double *const *phi)
{
    size_t one = NONE;
    for (size_t c = 0; c < scene->rows; c++)
        if (phi[c] && (one == NONE || motion_bears(midpoint->force[c])))
            one = c;
    return one;
}

/* Turns a group that no contact moves. */
static void turn_on(const struct kernel_carry *carry, const struct scene_group *group,
                    double *const state[2])
{
    kernel_turn(carry->from, carry->turn, 1.0, group->stride,
                (const double *const[]){state[0], state[1]}, state);
}

/* The same in one pass, to a step at most twice or half as long. */
static void enter_next(const struct midpoint *midpoint, const struct scene *scene, size_t g,
                       struct kernel_carry *carry, double (*sums)[STEP_POINTS])
{
    const struct scene_group *group = &scene->group[g];
    const double *const *phi = group->participation;
    double *const state[2] = {midpoint->q[g], midpoint->v[g]};
    carry->from = middle_of(group, midpoint->level);
    size_t one = choose_one(midpoint, scene, phi);
    if (one == NONE) {
        turn_on(carry, group, state);
        return;
    }
    /* the others: forces before it, approaches after it */
    carry->force = midpoint->force[one];
    for (size_t c = 0; c < scene->rows; c++)
        if (c != one && phi[c] && motion_bears(midpoint->force[c]))
            kernel_kick(carry->from, group->stride, phi[c], midpoint->force[c], state);
    kernel_carry(carry, group->stride, phi[one], state, sums[one]);
    for (size_t c = 0; c < scene->rows; c++)
        if (c != one && phi[c])
            kernel_swing(carry->next, group->stride, phi[c],
                         (const double *const[]){state[0], state[1]}, sums[c]);
}

/* The same for a damped group, from the step's start. */
static void enter_damped(const struct scene *scene, const struct scene_group *group,
                         const double *const start[2], int level, double (*sums)[STEP_POINTS])
{
    for (size_t c = 0; c < scene->rows; c++)
        if (group->participation[c])
            kernel_nodes(group->set->tables[level], group->stride, group->participation[c],
                         start[0], start[1], sums[c]);
}

static void enter_groups(const struct midpoint *midpoint, const struct scene *scene,
                         const struct motion *motion, int level, double (*sums)[STEP_POINTS])
{
    struct kernel_carry carry = {0};
    memset(sums, 0, scene->rows * sizeof *sums);
    bool next = midpoint->force && find_turn(midpoint->level, level, &carry.turn);
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *const start[2] = {motion->q[g], motion->v[g]};
        carry.next = middle_of(group, level);
        if (!carry.next)
            enter_damped(scene, group, start, level, sums);
        else if (next)
            enter_next(midpoint, scene, g, &carry, sums);
        else
            enter(midpoint, scene, g, start, level, sums);
    }
}

/* Fast path of most steps: one contact, undamped modes, a taken step and one about as long. False:
 * it does not apply. */
static inline bool enter_only(const struct midpoint *midpoint, const struct scene *scene, int level,
                              double sums[STEP_POINTS])
{
    struct kernel_carry carry;
    if (scene->rows != 1 || midpoint->damped || !midpoint->force ||
        !find_turn(midpoint->level, level, &carry.turn))
        return false;
    carry.force = midpoint->force[0];
    carry.nodes_only = midpoint->nodes_only;
    for (int i = 0; i < STEP_POINTS; i++)
        sums[i] = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *phi = group->participation[0];
        double *const state[2] = {midpoint->q[g], midpoint->v[g]};
        carry.from = middle_of(group, midpoint->level);
        carry.next = middle_of(group, level);
        if (phi)
            kernel_carry(&carry, group->stride, phi, state, sums);
        else
            turn_on(&carry, group, state);
    }
    return true;
}

void midpoint_enter(struct midpoint *midpoint, const struct scene *scene,
                    const struct motion *motion, int level, double (*sums)[STEP_POINTS])
{
    if (!enter_only(midpoint, scene, level, sums[0]))
        enter_groups(midpoint, scene, motion, level, sums);
    midpoint->level = level;
    midpoint->force = NULL;
}

/* Moves the only row's rigid gap to the end of a step, without loops. */
static inline void take_gap(const struct scene *scene, struct motion *motion, int level,
                            const double force[NODES])
{
    double impulse;
    double travel;
    double h = step_length(level);
    double a = scene->gap_acceleration[0];
    motion->time += h;
    motion->gap[0] += h * (motion->gap_rate[0] + 0.5 * a * h);
    motion->gap_rate[0] += a * h;
    motion_integrate(force, h, &impulse, &travel);
    motion->gap[0] += scene->w[0] * travel;
    motion->gap_rate[0] += scene->w[0] * impulse;
}

/* Moves the gaps of several rows. */
static void take_gaps(const struct scene *scene, struct motion *motion, int level,
                      double (*const force)[NODES])
{
    motion_step_gaps(motion, motion, scene, level);
    for (size_t c = 0; c < scene->rows; c++)
        if (motion_bears(force[c]))
            motion_push_gaps(motion, scene, level, c, force[c]);
}

/* Moves damped modes to the step's end. */
static void take_damped(const struct scene *scene, struct motion *motion, int level,
                        double (*const force)[NODES])
{
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const struct step_table *table = group->set->tables[level];
        if (table->middle)
            continue;
        kernel_advance(table, group->stride, motion->q[g], motion->v[g], motion->q[g],
                       motion->v[g]);
        for (size_t c = 0; c < scene->rows; c++)
            if (group->participation[c] && motion_bears(force[c]))
                kernel_push(table, group->stride, group->participation[c], force[c], motion->q[g],
                            motion->v[g]);
    }
}

void midpoint_take(struct midpoint *midpoint, const struct scene *scene, struct motion *motion,
                   double (*const force)[NODES])
{
    midpoint->force = (const double(*)[NODES])force;
    if (scene->rows == 1)
        take_gap(scene, motion, midpoint->level, force[0]);
    else
        take_gaps(scene, motion, midpoint->level, force);
    if (midpoint->damped)
        take_damped(scene, motion, midpoint->level, force);
}

void midpoint_leave(struct midpoint *midpoint, const struct scene *scene, struct motion *motion)
{
    for (size_t g = 0; midpoint->level >= 0 && g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *middle = middle_of(group, midpoint->level);
        double *const state[2] = {midpoint->q[g], midpoint->v[g]};
        if (!middle)
            continue;
        if (midpoint->force)
            kick(midpoint, scene, group, state);
        kernel_turn(middle, TURN_HALF, midpoint->force ? 1.0 : -1.0, group->stride,
                    (const double *const[]){state[0], state[1]},
                    (double *const[]){motion->q[g], motion->v[g]});
    }
    midpoint->level = NO_STEP;
    midpoint->force = NULL;
}
