/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/sensitivity_group.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "impact/coupling.h"
#include "impact/impact_scale.h"
#include "impact/midpoint.h"

/* An opening shorter than this share of the step after it is rounding of the time. */
static const double NO_FLIGHT = 1e-3;

/* Changes of smaller sub-impacts are related to this share of the group's largest impulse. */
static const double GRAZE = 0.05;

/* One change on its way through the log. */
struct way {
    const struct sensitivity_source *source; /* [contact] */
    struct motion motion;                    /* the change of it */
    struct midpoint midpoint;
    double (*target)[STEP_POINTS]; /* [contact], that of the approaches by the motion before */
    double (*force)[NODES];        /* [contact], that of the forces on this step */
    double *change;                /* [contact], of the impulse of the sub-impact under way */
};

struct follower {
    struct scene scene; /* at rest, where nothing presses */
    struct coupling coupling;
    struct arena *arena;
    struct pace *pace;
    size_t count;
    struct way way[TANGENT_GROUP_MOST];
    struct sensitivity_group *tangent; /* [count] */
    double *total;                     /* [contact], impulse of the sub-impact under way */
    bool lost;                         /* a step could not be followed */
    double least;                      /* reference impulse of small sub-impacts, N s */
    /* of the step under way, [contact] */
    double (*stiffness)[NODES], (*slack)[NODES]; /* of the laws, K and F/K */
    struct node_linear linear;                   /* of contacts with a force */
};

/* The scene at rest. */
static bool create_scene(struct follower *follower, const struct scene *scene)
{
    double *none = arena_take(follower->arena, scene->contacts, sizeof *none);
    struct scene_group *groups = arena_take(follower->arena, scene->groups, sizeof *groups);
    if (!none || !groups)
        return false;
    for (size_t g = 0; g < scene->groups; g++) {
        groups[g] = scene->group[g];
        groups[g].q = groups[g].v = NULL;
    }
    follower->scene = *scene;
    follower->scene.group = groups;
    follower->scene.gap = follower->scene.gap_rate = follower->scene.gap_acceleration = none;
    return coupling_create(&follower->coupling, &follower->scene, follower->arena);
}

static bool create_way(struct way *way, const struct sensitivity_source *source,
                       const struct scene *scene, struct arena *arena)
{
    size_t n = scene->contacts;
    way->source = source;
    way->target = arena_take(arena, n, sizeof *way->target);
    way->force = arena_take(arena, n, sizeof *way->force);
    way->change = arena_take(arena, n, sizeof *way->change);
    if (!way->target || !way->force || !way->change || !motion_create(&way->motion, scene, arena) ||
        !midpoint_create(&way->midpoint, scene, arena))
        return false;
    motion_start(&way->motion, scene);
    return true;
}

static bool create(struct follower *follower, const struct sensitivity_group_task *task)
{
    size_t n = task->scene->contacts;
    struct arena *arena = follower->arena;
    follower->total = arena_take(arena, n, sizeof *follower->total);
    follower->stiffness = arena_take(arena, n, sizeof *follower->stiffness);
    follower->slack = arena_take(arena, n, sizeof *follower->slack);
    if (!follower->total || !follower->stiffness || !follower->slack ||
        !create_scene(follower, task->scene))
        return false;
    for (size_t i = 0; i < task->count; i++)
        if (!create_way(&follower->way[i], task->source[i], &follower->scene, arena))
            return false;
    return true;
}

/* Impulse of a contact's forces on a step. */
static double impulse_of(const double force[NODES], double h)
{
    double sum = 0.0;
    for (int j = 0; j < NODES; j++)
        sum += collocation.weight[j] * force[j];
    return h * sum;
}

/* The largest impulse of a contact. `sum`, [contact], is scratch and becomes 0. */
static double largest_impulse(const struct force_log *log, double *sum)
{
    double largest = 0.0;
    for (size_t c = 0; c < log->rows; c++)
        sum[c] = 0.0;
    for (size_t i = 0; i < log->count; i++)
        for (size_t c = 0; c < log->rows; c++)
            sum[c] += impulse_of(log->steps[i].force[c], step_length(log->steps[i].level));
    for (size_t c = 0; c < log->rows; c++) {
        largest = fmax(largest, sum[c]);
        sum[c] = 0.0;
    }
    return largest;
}

/* Subtracts the direct effect of a source from a contact's approach at the nodes, by the
 * derivatives of the force's cubic. The change of the law's force acts through the forces. */
static void take_own(const struct sensitivity_source *source, double h, const double force[NODES],
                     double approach[STEP_POINTS])
{
    double a[NODES] = {0.0};
    for (int i = 0; i < NODES; i++)
        approach[i] -= source->compliance * force[i];
    if (source->viscosity == 0.0 && source->inertia == 0.0)
        return;
    for (int j = 0; j < NODES; j++)
        for (int k = 1; k < NODES; k++)
            a[k] += collocation.monomial[j][k] * force[j];
    for (int i = 0; i < NODES; i++) {
        double s = collocation.node[i];
        double first = (a[1] + s * (2.0 * a[2] + 3.0 * s * a[3])) / h;
        double second = (2.0 * a[2] + 6.0 * s * a[3]) / (h * h);
        approach[i] += source->viscosity * first + source->inertia * second;
    }
}

/* Changes of the approaches at the nodes by the motion before the step. */
static void find_targets(const struct follower *follower, struct way *way, int level)
{
    double h = step_length(level);
    midpoint_enter(&way->midpoint, &follower->scene, &way->motion, level, way->target);
    for (size_t c = 0; c < follower->scene.contacts; c++) {
        double *target = way->target[c];
        double gap = way->motion.gap[c];
        double travel = h * way->motion.gap_rate[c];
        for (int i = 0; i < NODES; i++)
            target[i] = -(gap + collocation.node[i] * travel) - target[i];
    }
}

/* With the stiffness K, the coupling M, the change f F of the law's forces F and the source's other
 * effects G F on the approach, the forces change by K d + f F = K x, and (1 + M K) x = target - G F
 * + f F/K. */
static void find_right(struct follower *follower, size_t which, const struct force_step *step)
{
    struct way *way = &follower->way[which];
    struct node_linear_row *row = follower->linear.row;
    double h = step_length(step->level);
    find_targets(follower, way, step->level);
    for (size_t p = 0; p < follower->linear.count; p++, row += NODES) {
        size_t c = follower->linear.contact[p];
        const struct sensitivity_source *source = &way->source[c];
        const double *slack = follower->slack[c];
        take_own(source, h, step->force[c], way->target[c]);
        for (int i = 0; i < NODES; i++)
            row[i].right[which] = way->target[c][i] + source->force * slack[i];
    }
}

/* The changes of the forces on a step. */
static void solve_step(struct follower *follower, const struct force_step *step)
{
    struct node_linear *linear = &follower->linear;
    for (size_t which = 0; which < follower->count; which++)
        find_right(follower, which, step);
    node_linear_fill(linear, &follower->coupling, step->level, follower->stiffness);
    follower->lost = !node_linear_solve(linear) || follower->lost;
    for (size_t which = 0; which < follower->count; which++) {
        struct way *way = &follower->way[which];
        memset(way->force, 0, follower->scene.contacts * sizeof *way->force);
        for (size_t p = 0; p < linear->count; p++)
            for (size_t i = 0; i < NODES; i++)
                way->force[linear->contact[p]][i] = follower->stiffness[linear->contact[p]][i] *
                                                    linear->row[p * NODES + i].right[which];
    }
}

/* A contact's sub-impact has ended, if one was under way. */
static void close_part(struct follower *follower, size_t contact)
{
    double total = follower->total[contact];
    follower->total[contact] = 0.0;
    if (!(total > 0.0))
        return;
    for (size_t i = 0; i < follower->count; i++) {
        struct sensitivity_group *tangent = &follower->tangent[i];
        double *change = &follower->way[i].change[contact];
        tangent->impulse[contact] += *change;
        tangent->strain = fmax(tangent->strain, fabs(*change) / fmax(total, follower->least));
        *change = 0.0;
    }
}

static void close_parts(struct follower *follower)
{
    for (size_t c = 0; c < follower->scene.contacts; c++)
        close_part(follower, c);
}

/* The contacts that bear a force on a step, and their laws' stiffness. */
static void find_stiffness(struct follower *follower, const struct force_step *step)
{
    follower->linear.count = 0;
    for (size_t c = 0; c < follower->scene.contacts; c++) {
        double *slack = follower->slack[c];
        const double *stiffness = follower->stiffness[c];
        if (!motion_bears(step->force[c])) {
            close_part(follower, c);
            continue;
        }
        follower->linear.contact[follower->linear.count++] = c;
        follower->total[c] += impulse_of(step->force[c], step_length(step->level));
        contact_law_forces(&follower->scene.laws[c], step->indentation[c], slack,
                           follower->stiffness[c]);
        for (int i = 0; i < NODES; i++)
            slack[i] = stiffness[i] > 0.0 ? slack[i] / stiffness[i] : 0.0;
    }
}

static enum percuss_status take_step(struct follower *follower, const struct force_step *step)
{
    struct coupling *coupling = &follower->coupling;
    if (!coupling->level[step->level]) {
        enum percuss_status status = coupling_prepare(coupling, &follower->scene, step->level,
                                                      follower->arena, follower->pace);
        if (status != PERCUSS_OK)
            return status;
    }
    find_stiffness(follower, step);
    solve_step(follower, step);
    for (size_t i = 0; i < follower->count; i++) {
        struct way *way = &follower->way[i];
        midpoint_take(&way->midpoint, &follower->scene, &way->motion, way->force);
        for (size_t p = 0; p < follower->linear.count; p++) {
            size_t c = follower->linear.contact[p];
            way->change[c] += impulse_of(way->force[c], step_length(step->level));
        }
    }
    return PERCUSS_OK;
}

/* Free motion from contact phase to contact phase. */
static void fly(struct follower *follower, double time)
{
    close_parts(follower);
    for (size_t i = 0; i < follower->count; i++) {
        struct way *way = &follower->way[i];
        midpoint_leave(&way->midpoint, &follower->scene, &way->motion);
        motion_turn(&way->motion, &follower->scene, time);
    }
}

enum percuss_status sensitivity_group_follow(const struct sensitivity_group_task *task,
                                             struct arena *arena, struct pace *pace,
                                             struct sensitivity_group *tangent)
{
    const struct force_log *log = task->log;
    struct follower *follower = arena_reserve(arena, 1, sizeof *follower);
    if (!follower)
        return PERCUSS_INTERNAL;
    memset(tangent, 0, task->count * sizeof *tangent);
    memset(follower, 0, offsetof(struct follower, linear)); /* `linear` is filled by each step */
    follower->arena = arena;
    follower->pace = pace;
    follower->count = task->count;
    follower->tangent = tangent;
    if (!create(follower, task))
        return PERCUSS_INTERNAL;
    follower->least = GRAZE * largest_impulse(log, follower->total);
    double cost = step_cost(task->scene);
    double end = log->count > 0 ? log->steps[0].start : 0.0;
    for (size_t i = 0; i < log->count; i++) {
        const struct force_step *step = &log->steps[i];
        double h = step_length(step->level);
        if (!pace_keeps(pace, cost))
            return PERCUSS_TIMEOUT;
        if (step->start - end > NO_FLIGHT * h)
            fly(follower, step->start - end);
        enum percuss_status status = take_step(follower, step);
        if (status != PERCUSS_OK)
            return status;
        end = step->start + h;
    }
    close_parts(follower);
    for (size_t i = 0; follower->lost && i < task->count; i++)
        tangent[i].strain = INFINITY;
    return PERCUSS_OK;
}
