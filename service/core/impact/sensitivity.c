/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/sensitivity.h"

#include <math.h>

#include "impact/impact_scale.h"
#include "impact/kernel.h"
#include "impact/midpoint.h"
#include "impact/node_factors.h"
#include "impact/simd.h"

/* An opening shorter than this share of the step after it is rounding of the time. */
static const double NO_FLIGHT = 1e-3;

/* Data of a step for all sources: the law's stiffness K at the nodes, the factors of 1 + M K with
 * the coupling M, and the flight before the step. */
struct path_step {
    double stiffness[NODES];
    struct node_factors factors;
    double impulse; /* of the solution */
    double flight;  /* s; 0: none */
    double **turns; /* see motion_turn_tables */
};

/* Coupling from forces to approaches on a step of a level: row i at node i, as contact_step's. */
struct path_level {
    double coupling[STEP_POINTS][NODES];
};

struct sensitivity_path {
    const struct force_log *log;
    struct scene scene;                     /* at rest, where nothing presses */
    struct path_level *levels[STEP_LEVELS]; /* NULL: no step is of it */
    struct path_step *steps;                /* [log->count] */
    bool sound;                             /* all steps can be followed */
    struct arena *arena;
};

/* Direct effect of the source on a step of a level: row i at node i. */
struct level_table {
    double own[NODES][NODES];
};

/* The changes of one order: of the motion, of the forces on this step, of the impulse of the
 * sub-impact under way. */
struct course {
    struct motion motion;
    struct midpoint midpoint;
    double force[1][NODES];
    double impulse;
};

struct follower {
    const struct sensitivity_path *path;
    const struct sensitivity_source *source;
    struct course first, second;
    struct level_table *tables[STEP_LEVELS];       /* NULL: not yet */
    double rate[NODES][NODES], bend[NODES][NODES]; /* see differentiate; 0: not needed */
    double total;                                  /* impulse of the sub-impact under way */
};

static bool create_course(struct course *course, const struct scene *scene, struct arena *arena)
{
    if (!motion_create(&course->motion, scene, arena) ||
        !midpoint_create(&course->midpoint, scene, arena))
        return false;
    course->midpoint.nodes_only = true;
    motion_start(&course->motion, scene);
    return true;
}

/* The scene at rest. False: out of memory. */
static bool calm(struct sensitivity_path *path, const struct scene *scene)
{
    double *none = arena_take(path->arena, 1, sizeof *none);
    struct scene_group *groups = arena_take(path->arena, scene->groups, sizeof *groups);
    if (!none || !groups)
        return false;
    for (size_t g = 0; g < scene->groups; g++) {
        groups[g] = scene->group[g];
        groups[g].q = groups[g].v = NULL;
    }
    path->scene = *scene;
    path->scene.group = groups;
    path->scene.gap = path->scene.gap_rate = path->scene.gap_acceleration = none;
    return true;
}

/* Decrease of the approach at node i by a unit force at node j: rigid bodies, series compliance and
 * modes. The tables of the level are ready. */
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

/* The coupling of the path's steps of a level. NULL: out of memory. */
static const struct path_level *find_level(struct sensitivity_path *path, int level)
{
    struct path_level **at = &path->levels[level];
    if (*at)
        return *at;
    *at = arena_take(path->arena, 1, sizeof **at);
    if (*at)
        find_coupling(&path->scene, level, (*at)->coupling);
    return *at;
}

/* The impulse of the forces over the step. */
static inline double impulse_of(const double force[NODES], double h)
{
    const double *weight = collocation.weight;
    return h * ((weight[0] * force[0] + weight[1] * force[1]) +
                (weight[2] * force[2] + weight[3] * force[3]));
}

/* Adds a step that begins `free` after the one before it. False: out of memory. */
static bool lay_step(struct sensitivity_path *path, const struct force_step *step, double free,
                     struct path_step *to)
{
    double same[NODES];
    struct node_row rows[NODES];
    const struct path_level *level = find_level(path, step->level);
    if (!level)
        return false;
    contact_law_forces(&path->scene.laws[0], step->indentation[0], same, to->stiffness);
    node_rows_make((const double(*)[NODES])level->coupling, to->stiffness, rows);
    to->factors = node_factors_make(rows);
    path->sound = path->sound && to->factors.sound;
    to->impulse = impulse_of(step->force[0], step_length(step->level));
    to->flight = 0.0;
    if (!(free > NO_FLIGHT * step_length(step->level)))
        return true;
    to->flight = free;
    to->turns = arena_reserve(path->arena, path->scene.groups, sizeof *to->turns);
    return to->turns && motion_turn_tables(&path->scene, free, path->arena, to->turns);
}

struct sensitivity_path *sensitivity_path_create(const struct scene *scene,
                                                 const struct force_log *log, struct arena *arena)
{
    struct sensitivity_path *path = arena_take(arena, 1, sizeof *path);
    if (!path)
        return NULL;
    path->log = log;
    path->sound = true;
    path->arena = arena;
    path->steps = arena_reserve(arena, log->count, sizeof *path->steps);
    if (!path->steps || !calm(path, scene))
        return NULL;
    double end = log->count > 0 ? log->steps[0].start : 0.0;
    for (size_t i = 0; i < log->count; i++) {
        const struct force_step *step = &log->steps[i];
        if (!lay_step(path, step, step->start - end, &path->steps[i]))
            return NULL;
        end = step->start + step_length(step->level);
    }
    return path;
}

/* Derivatives of the force's cubic at the nodes, by the step's own time: row i at node i. */
static void differentiate(double first[NODES][NODES], double second[NODES][NODES])
{
    for (int i = 0; i < NODES; i++)
        for (int j = 0; j < NODES; j++) {
            double s = collocation.node[i];
            const double *a = collocation.monomial[j];
            first[i][j] = a[1] + s * (2.0 * a[2] + 3.0 * s * a[3]);
            second[i][j] = 2.0 * a[2] + 6.0 * s * a[3];
        }
}

/* Decrease of the approach at node i by the source under a unit force at node j: its inertia and
 * viscosity by the cubic's derivatives, its force by the level's coupling. NULL: out of memory. */
static const struct level_table *find_table(struct follower *follower, int level)
{
    const struct sensitivity_source *source = follower->source;
    struct level_table *table = follower->tables[level];
    if (table)
        return table;
    table = arena_reserve(follower->path->arena, 1, sizeof *table);
    if (!table)
        return NULL;
    const struct path_level *met = follower->path->levels[level];
    double h = step_length(level);
    double viscosity = source->viscosity / h;
    double inertia = source->inertia / (h * h);
    for (int i = 0; i < NODES; i++) {
        for (int j = 0; j < NODES; j += 2)
            NODE_PAIR(table->own[i] + j) = source->force * NODE_CONST_PAIR(met->coupling[i] + j) -
                                           viscosity * NODE_CONST_PAIR(follower->rate[i] + j) -
                                           inertia * NODE_CONST_PAIR(follower->bend[i] + j);
        table->own[i][i] += source->compliance;
    }
    return follower->tables[level] = table;
}

/* A pair with one number in both lanes. */
static inline node_pair pair_of(double number)
{
    return (node_pair){number, number};
}

/* Products of rows i and i + 1 of a table with the forces at the nodes. */
static inline node_pair rows_by(const double (*rows)[NODES], int i, const double force[NODES])
{
    const node_pair low = NODE_CONST_PAIR(force);
    const node_pair high = NODE_CONST_PAIR(force + 2);
    node_pair one = NODE_CONST_PAIR(rows[i]) * low + NODE_CONST_PAIR(rows[i] + 2) * high;
    node_pair next = NODE_CONST_PAIR(rows[i + 1]) * low + NODE_CONST_PAIR(rows[i + 1] + 2) * high;
    return FOLD_BOTH(one, next);
}

/* Change of the approaches at the nodes by the motion before the step, less `rows` times the
 * forces. */
static void find_approaches(const struct scene *scene, struct course *course, int level,
                            const double (*rows)[NODES], const double force[NODES],
                            double approach[NODES])
{
    double sums[1][STEP_POINTS];
    const struct motion *motion = &course->motion;
    node_pair gap = pair_of(motion->gap[0]);
    node_pair travel = pair_of(step_length(level) * motion->gap_rate[0]);
    midpoint_enter(&course->midpoint, scene, motion, level, sums);
    for (int i = 0; i < NODES; i += 2) {
        node_pair away = gap + NODE_CONST_PAIR(collocation.node + i) * travel;
        away += NODE_CONST_PAIR(sums[0] + i);
        NODE_PAIR(approach + i) = -(away + rows_by(rows, i, force));
    }
}

/* Moves on by the forces of the step and adds their impulse. */
static inline void move_on(const struct scene *scene, struct course *course, double h)
{
    midpoint_take(&course->midpoint, scene, &course->motion, course->force);
    course->impulse += impulse_of(course->force[0], h);
}

/* With the law's stiffness K at the nodes, the coupling M and the source's effects f F on the
 * forces F and G F on the approach: (1 + M K) d = approach - G F; F changes by K d + f F. */
static void solve_first(struct follower *follower, const struct level_table *table,
                        const struct force_step *step, const struct path_step *slopes,
                        double d[NODES])
{
    struct course *course = &follower->first;
    double right[NODES];
    const double *force = step->force[0];
    find_approaches(&follower->path->scene, course, step->level, (const double(*)[NODES])table->own,
                    force, right);
    node_factors_solve(&slopes->factors, right, d);
    const node_pair f = pair_of(follower->source->force);
    for (int i = 0; i < NODES; i += 2)
        NODE_PAIR(course->force[0] + i) =
            NODE_CONST_PAIR(slopes->stiffness + i) * NODE_CONST_PAIR(d + i) +
            f * NODE_CONST_PAIR(force + i);
    move_on(&follower->path->scene, course, step_length(step->level));
}

/* The second derivatives by the size s of the change, of forces exp(s f) F(d) and the approach that
 * a compliance s c takes: with those that are known, f' and d', and d'' of the indentation,
 *
 *   F'' = K d'' + g,  g = K' d'^2 + 2 f F' - f^2 F,  (1 + M K) d'' = approach'' - M g - 2 c F'
 *
 * where K' = K/(2 d) by a law like d^(3/2). It is unbounded where contacts begin and end, but
 * integrable: the nodes miss some tenth of a step of it there. */
static void solve_second(struct follower *follower, const struct force_step *step,
                         const struct path_step *slopes, const double d[NODES])
{
    struct course *course = &follower->second;
    const node_pair f = pair_of(follower->source->force);
    double right[NODES];
    double bent[NODES];
    double second[NODES];
    const double *changed = follower->first.force[0];
    const struct path_level *level = follower->path->levels[step->level];
    for (int i = 0; i < NODES; i += 2) {
        node_pair depth = NODE_CONST_PAIR(step->indentation[0] + i);
        node_pair slope = NODE_CONST_PAIR(slopes->stiffness + i) / (2.0 * depth);
        slope = (node_pair)((pair_mask)slope & (depth > 0.0)); /* open: none */
        NODE_PAIR(bent + i) =
            slope * NODE_CONST_PAIR(d + i) * NODE_CONST_PAIR(d + i) +
            f * (2.0 * NODE_CONST_PAIR(changed + i) - f * NODE_CONST_PAIR(step->force[0] + i));
    }
    find_approaches(&follower->path->scene, course, step->level,
                    (const double(*)[NODES])level->coupling, bent, right);
    const node_pair twice = pair_of(2.0 * follower->source->compliance);
    for (int i = 0; i < NODES; i += 2)
        NODE_PAIR(right + i) -= twice * NODE_CONST_PAIR(changed + i);
    node_factors_solve(&slopes->factors, right, second);
    for (int i = 0; i < NODES; i += 2)
        NODE_PAIR(course->force[0] + i) =
            NODE_CONST_PAIR(slopes->stiffness + i) * NODE_CONST_PAIR(second + i) +
            NODE_CONST_PAIR(bent + i);
    move_on(&follower->path->scene, course, step_length(step->level));
}

static bool take_step(struct follower *follower, const struct force_step *step,
                      const struct path_step *slopes)
{
    double d[NODES];
    const struct level_table *table = find_table(follower, step->level);
    if (!table)
        return false;
    solve_first(follower, table, step, slopes, d);
    if (follower->source->curved)
        solve_second(follower, step, slopes, d);
    follower->total += slopes->impulse;
    return true;
}

/* Moves freely from sub-impact to sub-impact. */
static void fly(const struct scene *scene, struct course *course, const struct path_step *step)
{
    midpoint_leave(&course->midpoint, scene, &course->motion);
    motion_turn_by(&course->motion, scene, step->flight, step->turns);
}

/* A sub-impact has ended. */
static void close_part(struct follower *follower, struct sensitivity *tangent)
{
    double change = follower->first.impulse;
    tangent->impulse += change;
    tangent->curvature += follower->second.impulse;
    tangent->largest = fmax(tangent->largest, fabs(tangent->impulse));
    double largest = fmax(fabs(change), 0.5 * fabs(follower->second.impulse));
    tangent->strain = fmax(tangent->strain, largest / follower->total);
    follower->total = follower->first.impulse = follower->second.impulse = 0.0;
}

/* At rest before the first step. False: out of memory. */
static bool begin(struct follower *follower)
{
    const struct sensitivity_path *path = follower->path;
    if (follower->source->viscosity != 0.0 || follower->source->inertia != 0.0)
        differentiate(follower->rate, follower->bend);
    return create_course(&follower->first, &path->scene, path->arena) &&
           (!follower->source->curved ||
            create_course(&follower->second, &path->scene, path->arena));
}

enum percuss_status sensitivity_follow(struct sensitivity_path *path,
                                       const struct sensitivity_source *source, struct pace *pace,
                                       struct sensitivity *tangent)
{
    struct follower follower = {.path = path, .source = source};
    *tangent = (struct sensitivity){0};
    if (!path || !begin(&follower))
        return PERCUSS_INTERNAL;
    const struct force_log *log = path->log;
    double cost = step_cost(&path->scene);
    for (size_t i = 0; i < log->count; i++) {
        const struct path_step *slopes = &path->steps[i];
        if (!pace_keeps(pace, cost))
            return PERCUSS_TIMEOUT;
        if (slopes->flight > 0.0) {
            close_part(&follower, tangent);
            fly(&path->scene, &follower.first, slopes);
            if (source->curved)
                fly(&path->scene, &follower.second, slopes);
        }
        if (!take_step(&follower, &log->steps[i], slopes))
            return PERCUSS_INTERNAL;
    }
    if (log->count > 0)
        close_part(&follower, tangent);
    if (!path->sound)
        tangent->strain = INFINITY;
    midpoint_leave(&follower.first.midpoint, &path->scene, &follower.first.motion);
    tangent->motion = follower.first.motion;
    return PERCUSS_OK;
}

double sensitivity_vibration(const struct sensitivity_path *path, const struct sensitivity *tangent,
                             size_t body)
{
    return motion_vibration(&tangent->motion, &path->scene, body);
}
