/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/tangent.h"

#include <math.h>

#include "impact/carrier.h"
#include "impact/kernel.h"
#include "impact/node_solver.h"
#include "impact/step_cost.h"

/* An opening shorter than this share of the step after it is rounding of the time. */
static const double NO_FLIGHT = 1e-3;

/* What forces do to approaches on a step of a level: row i at node i. */
struct level_table {
    double coupling[STEP_POINTS][NODES]; /* as contact_step's */
    double own[NODES][NODES];            /* the source's */
};

struct follower {
    const struct tangent_source *source;
    struct scene scene;   /* at rest, where nothing presses */
    struct motion motion; /* the change of it */
    struct carrier carrier;
    struct level_table *tables[STEP_LEVELS]; /* NULL: not yet */
    double force[1][NODES];                  /* the change of the forces on this step */
    struct arena *arena;
    double total, change; /* impulse of the sub-impact under way, and its change */
    bool lost;            /* a step could not be followed */
};

static bool create(struct follower *follower, const struct scene *scene)
{
    double *none = arena_take(follower->arena, 1, sizeof *none);
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
    if (!motion_create(&follower->motion, &follower->scene, follower->arena) ||
        !carrier_create(&follower->carrier, &follower->scene, follower->arena))
        return false;
    motion_start(&follower->motion, &follower->scene);
    return true;
}

/* What a unit force at node j does to the approach at node i: rigid bodies, series compliance and
 * modes, whose tables are ready. */
static void find_coupling(const struct scene *scene, int level, double m[STEP_POINTS][NODES])
{
    double h = step_length(level);
    for (int i = 0; i < NODES; i++) {
        for (int j = 0; j < NODES; j++)
            m[i][j] = scene->w[0] * h * h * collocation.position[i][j];
        m[i][i] += scene->residual[0];
    }
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *phi = group->participation[0];
        if (phi)
            kernel_response(group->set->tables[level], group->stride, phi, phi, m);
    }
}

/* What the source takes from the approach at node i by a unit force at node j, whose coupling is m:
 * its inertia and viscosity by the derivatives of the force's cubic, its force by the coupling. */
static double find_own(const struct tangent_source *source, double h, double m, int i, int j)
{
    double s = collocation.node[i];
    const double *a = collocation.monomial[j];
    double first = (a[1] + s * (2.0 * a[2] + 3.0 * s * a[3])) / h;
    double second = (2.0 * a[2] + 6.0 * s * a[3]) / (h * h);
    double compliance = i == j ? source->compliance : 0.0;
    return compliance + source->force * m - source->viscosity * first - source->inertia * second;
}

/* The table of a level. NULL: out of memory. */
static const struct level_table *find_table(struct follower *follower, int level)
{
    struct level_table *table = follower->tables[level];
    if (table)
        return table;
    table = arena_take(follower->arena, 1, sizeof *table);
    if (!table)
        return NULL;
    find_coupling(&follower->scene, level, table->coupling);
    for (int i = 0; i < NODES; i++)
        for (int j = 0; j < NODES; j++)
            table->own[i][j] =
                find_own(follower->source, step_length(level), table->coupling[i][j], i, j);
    return follower->tables[level] = table;
}

/* Changes of the approaches at the nodes by what was before the step. */
static void find_approaches(struct follower *follower, int level, double approach[NODES])
{
    double sums[1][STEP_POINTS];
    const struct motion *motion = &follower->motion;
    double travel = step_length(level) * motion->gap_rate[0];
    carrier_enter(&follower->carrier, &follower->scene, motion, level, sums);
    for (int i = 0; i < NODES; i++)
        approach[i] = -(motion->gap[0] + collocation.node[i] * travel) - sums[0][i];
}

/* With the law's stiffness K at the nodes, the coupling M and what the source does by itself, f to
 * the forces F and G F to the approach, (1 + M K) d = approach - G F, and F changes by K d + f. */
static void solve_step(struct follower *follower, const struct level_table *table,
                       const struct force_step *step, const double approach[NODES])
{
    double stiffness[NODES];
    double same[NODES];
    double right[NODES];
    double d[NODES];
    const double *force = step->force[0];
    contact_law_forces(&follower->scene.laws[0], step->indentation[0], same, stiffness);
    for (int i = 0; i < NODES; i++) {
        const double *own = table->own[i];
        right[i] = approach[i] - ((own[0] * force[0] + own[1] * force[1]) +
                                  (own[2] * force[2] + own[3] * force[3]));
    }
    if (!node_solve_linear((const double(*)[NODES])table->coupling, stiffness, right, d))
        follower->lost = true;
    for (int i = 0; i < NODES; i++)
        follower->force[0][i] = stiffness[i] * d[i] + follower->source->force * force[i];
}

static bool take_step(struct follower *follower, const struct force_step *step)
{
    double d[NODES];
    double h = step_length(step->level);
    const struct level_table *table = find_table(follower, step->level);
    if (!table)
        return false;
    /* the change of the forces, and the motion under them */
    find_approaches(follower, step->level, d);
    solve_step(follower, table, step, d);
    carrier_take(&follower->carrier, &follower->scene, &follower->motion, follower->force);
    /* impulses */
    for (int i = 0; i < NODES; i++) {
        follower->total += h * collocation.weight[i] * step->force[0][i];
        follower->change += h * collocation.weight[i] * follower->force[0][i];
    }
    return true;
}

/* A sub-impact has ended. */
static void close_part(struct follower *follower, struct tangent *tangent)
{
    tangent->impulse += follower->change;
    tangent->largest = fmax(tangent->largest, fabs(tangent->impulse));
    tangent->strain = fmax(tangent->strain, fabs(follower->change) / follower->total);
    follower->total = follower->change = 0.0;
}

enum percuss_status tangent_follow(const struct scene *scene, const struct force_log *log,
                                   const struct tangent_source *source, struct arena *arena,
                                   struct pace *pace, struct tangent *tangent)
{
    struct follower *follower = arena_take(arena, 1, sizeof *follower);
    if (!follower)
        return PERCUSS_INTERNAL;
    *tangent = (struct tangent){0};
    *follower = (struct follower){.source = source, .arena = arena};
    if (!create(follower, scene))
        return PERCUSS_INTERNAL;
    double cost = step_cost(scene);
    double end = log->count > 0 ? log->steps[0].start : 0.0;
    for (size_t i = 0; i < log->count; i++) {
        const struct force_step *step = &log->steps[i];
        double h = step_length(step->level);
        if (!pace_keeps(pace, cost))
            return PERCUSS_TIMEOUT;
        /* free motion from sub-impact to sub-impact */
        if (step->start - end > NO_FLIGHT * h) {
            close_part(follower, tangent);
            carrier_leave(&follower->carrier, &follower->scene, &follower->motion);
            motion_turn(&follower->motion, &follower->scene, step->start - end);
        }
        if (!take_step(follower, step))
            return PERCUSS_INTERNAL;
        end = step->start + h;
    }
    if (log->count > 0)
        close_part(follower, tangent);
    if (follower->lost)
        tangent->strain = INFINITY;
    return PERCUSS_OK;
}
