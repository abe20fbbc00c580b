/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/carrier.h"

#include <string.h>

#include "impact/kernel.h"

/* No step has been entered. */
enum { NO_STEP = -1 };

bool carrier_create(struct carrier *carrier, const struct scene *scene, struct arena *arena)
{
    *carrier = (struct carrier){.level = NO_STEP};
    /* pairs of consecutive arrays */
    carrier->q = arena_reserve(arena, 2 * scene->groups, sizeof *carrier->q);
    if (!carrier->q)
        return false;
    carrier->v = carrier->q + scene->groups;
    for (size_t g = 0; g < scene->groups; g++) {
        carrier->damped = carrier->damped || scene->group[g].set->most_damping > 0.0;
        size_t stride = scene->group[g].stride; /* whole lanes: both are aligned */
        carrier->q[g] = arena_reserve(arena, 2 * stride, sizeof **carrier->q);
        if (!carrier->q[g])
            return false;
        carrier->v[g] = carrier->q[g] + stride;
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
static void kick(const struct carrier *carrier, const struct scene *scene,
                 const struct scene_group *group, double *const state[2])
{
    const double *middle = middle_of(group, carrier->level);
    for (size_t c = 0; c < scene->contacts; c++)
        if (group->participation[c] && motion_bears(carrier->force[c]))
            kernel_kick(middle, group->stride, group->participation[c], carrier->force[c], state);
}

/* Turns undamped modes from their instant to the middle of the step of `level`. */
static void turn_to(const struct carrier *carrier, const struct scene_group *group,
                    const double *const start[2], int level, double *const state[2])
{
    const double *const here[2] = {state[0], state[1]};
    const double *from = carrier->level < 0 ? NULL : middle_of(group, carrier->level);
    /* to the last step's end, or back to its start if it was not taken */
    if (from)
        kernel_turn(from, TURN_HALF, carrier->force ? 1.0 : -1.0, group->stride, here, state);
    kernel_turn(middle_of(group, level), TURN_HALF, 1.0, group->stride, from ? here : start, state);
}

/* Moves a group's undamped modes to a step of `level`, pass by pass. */
static void enter(const struct carrier *carrier, const struct scene *scene, size_t g,
                  const double *const start[2], int level, double (*sums)[STEP_POINTS])
{
    const struct scene_group *group = &scene->group[g];
    double *const state[2] = {carrier->q[g], carrier->v[g]};
    if (carrier->force)
        kick(carrier, scene, group, state);
    turn_to(carrier, group, start, level, state);
    for (size_t c = 0; c < scene->contacts; c++)
        if (group->participation[c])
            kernel_swing(middle_of(group, level), group->stride, group->participation[c],
                         (const double *const[]){state[0], state[1]}, sums[c]);
}

/* Chooses the contact for the pass that includes the turn: one that moves the group, and bears a
 * force if any such does. NONE: no contact moves it. */
enum { NONE = PERCUSS_MAX_CONTACTS };
static size_t choose_one(const struct carrier *carrier, const struct scene *scene,
                         const double *const *phi)
{
    size_t one = NONE;
    for (size_t c = 0; c < scene->contacts; c++)
        if (phi[c] && (one == NONE || motion_bears(carrier->force[c])))
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
static void enter_next(const struct carrier *carrier, const struct scene *scene, size_t g,
                       struct kernel_carry *carry, double (*sums)[STEP_POINTS])
{
    const struct scene_group *group = &scene->group[g];
    const double *const *phi = group->participation;
    double *const state[2] = {carrier->q[g], carrier->v[g]};
    carry->from = middle_of(group, carrier->level);
    size_t one = choose_one(carrier, scene, phi);
    if (one == NONE) {
        turn_on(carry, group, state);
        return;
    }
    /* the others: forces before it, approaches after it */
    carry->force = carrier->force[one];
    for (size_t c = 0; c < scene->contacts; c++)
        if (c != one && phi[c] && motion_bears(carrier->force[c]))
            kernel_kick(carry->from, group->stride, phi[c], carrier->force[c], state);
    kernel_carry(carry, group->stride, phi[one], state, sums[one]);
    for (size_t c = 0; c < scene->contacts; c++)
        if (c != one && phi[c])
            kernel_swing(carry->next, group->stride, phi[c],
                         (const double *const[]){state[0], state[1]}, sums[c]);
}

/* The same for a damped group, from the step's start. */
static void enter_damped(const struct scene *scene, const struct scene_group *group,
                         const double *const start[2], int level, double (*sums)[STEP_POINTS])
{
    for (size_t c = 0; c < scene->contacts; c++)
        if (group->participation[c])
            kernel_nodes(group->set->tables[level], group->stride, group->participation[c],
                         start[0], start[1], sums[c]);
}

static void enter_groups(const struct carrier *carrier, const struct scene *scene,
                         const struct motion *motion, int level, double (*sums)[STEP_POINTS])
{
    struct kernel_carry carry = {0};
    memset(sums, 0, scene->contacts * sizeof *sums);
    bool next = carrier->force && find_turn(carrier->level, level, &carry.turn);
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *const start[2] = {motion->q[g], motion->v[g]};
        carry.next = middle_of(group, level);
        if (!carry.next)
            enter_damped(scene, group, start, level, sums);
        else if (next)
            enter_next(carrier, scene, g, &carry, sums);
        else
            enter(carrier, scene, g, start, level, sums);
    }
}

/* Fast path of most steps: one contact, undamped modes, a taken step and one about as long. False:
 * it does not apply. */
static inline bool enter_only(const struct carrier *carrier, const struct scene *scene, int level,
                              double sums[STEP_POINTS])
{
    struct kernel_carry carry;
    if (scene->contacts != 1 || carrier->damped || !carrier->force ||
        !find_turn(carrier->level, level, &carry.turn))
        return false;
    carry.force = carrier->force[0];
    carry.nodes_only = carrier->nodes_only;
    for (int i = 0; i < STEP_POINTS; i++)
        sums[i] = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *phi = group->participation[0];
        double *const state[2] = {carrier->q[g], carrier->v[g]};
        carry.from = middle_of(group, carrier->level);
        carry.next = middle_of(group, level);
        if (phi)
            kernel_carry(&carry, group->stride, phi, state, sums);
        else
            turn_on(&carry, group, state);
    }
    return true;
}

void carrier_enter(struct carrier *carrier, const struct scene *scene, const struct motion *motion,
                   int level, double (*sums)[STEP_POINTS])
{
    if (!enter_only(carrier, scene, level, sums[0]))
        enter_groups(carrier, scene, motion, level, sums);
    carrier->level = level;
    carrier->force = NULL;
}

/* Moves the only contact's rigid gap to the end of a step, without loops. */
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

/* Moves the gaps of several contacts. */
static void take_gaps(const struct scene *scene, struct motion *motion, int level,
                      double (*const force)[NODES])
{
    motion_step_gaps(motion, motion, scene, level);
    for (size_t c = 0; c < scene->contacts; c++)
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
        for (size_t c = 0; c < scene->contacts; c++)
            if (group->participation[c] && motion_bears(force[c]))
                kernel_push(table, group->stride, group->participation[c], force[c], motion->q[g],
                            motion->v[g]);
    }
}

void carrier_take(struct carrier *carrier, const struct scene *scene, struct motion *motion,
                  double (*const force)[NODES])
{
    carrier->force = (const double(*)[NODES])force;
    if (scene->contacts == 1)
        take_gap(scene, motion, carrier->level, force[0]);
    else
        take_gaps(scene, motion, carrier->level, force);
    if (carrier->damped)
        take_damped(scene, motion, carrier->level, force);
}

void carrier_leave(struct carrier *carrier, const struct scene *scene, struct motion *motion)
{
    for (size_t g = 0; carrier->level >= 0 && g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *middle = middle_of(group, carrier->level);
        double *const state[2] = {carrier->q[g], carrier->v[g]};
        if (!middle)
            continue;
        if (carrier->force)
            kick(carrier, scene, group, state);
        kernel_turn(middle, TURN_HALF, carrier->force ? 1.0 : -1.0, group->stride,
                    (const double *const[]){state[0], state[1]},
                    (double *const[]){motion->q[g], motion->v[g]});
    }
    carrier->level = NO_STEP;
    carrier->force = NULL;
}
