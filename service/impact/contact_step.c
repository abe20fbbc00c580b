/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/contact_step.h"

#include <math.h>
#include <string.h>

#include "impact/kernel.h"
#include "impact/node_solver.h"
#include "numeric/linear.h"

enum { MAX_ITERATIONS = 40 };

bool contact_step_create(struct contact_step *step, const struct scene *scene, struct arena *arena)
{
    size_t n = scene->contacts;
    size_t unknowns = n * NODES;
    *step = (struct contact_step){.arena = arena};
    step->indentation = arena_take(arena, n, sizeof *step->indentation);
    step->force = arena_take(arena, n, sizeof *step->force);
    step->stiffness = arena_take(arena, n, sizeof *step->stiffness);
    step->end_indentation = arena_take(arena, n, sizeof(double));
    step->matrix = arena_take(arena, unknowns * unknowns, sizeof(double));
    step->residual = arena_take(arena, unknowns, sizeof(double));
    step->target = arena_take(arena, n, sizeof *step->target);
    step->approach = arena_take(arena, n, sizeof(double));
    step->end_force = arena_take(arena, n, sizeof(double));
    return step->indentation && step->force && step->stiffness && step->end_indentation &&
           step->matrix && step->residual && step->target && step->approach && step->end_force &&
           motion_create(&step->end, scene, arena);
}

/* What a unit force of contact b at node j does to the approach of contact a at node i, with the
 * residual flexibility: rigid double integral, modes, and the series compliance at the same node.
 */
static const double (*coupling_of_level(struct contact_step *step, const struct scene *scene,
                                        int level))[NODES][NODES]
{
    if (step->coupling[level])
        return (const double(*)[NODES][NODES])step->coupling[level];
    size_t n = scene->contacts;
    double h = step_length(level);
    double(*all)[NODES][NODES] = arena_take(step->arena, n * n, sizeof *all);
    if (!all)
        return NULL;
    for (size_t a = 0; a < n; a++) {
        for (size_t b = 0; b <= a; b++) {
            double(*m)[NODES] = all[a * n + b];
            for (int i = 0; i < NODES; i++) {
                for (int j = 0; j < NODES; j++)
                    m[i][j] = scene->w[a * n + b] * h * h * collocation.position[i][j];
                m[i][i] += scene->residual[a * n + b];
            }
            for (size_t g = 0; g < scene->groups; g++) {
                const struct scene_group *group = &scene->group[g];
                const double *pa = group->participation[a];
                const double *pb = group->participation[b];
                /* a level's tables take milliseconds to make */
                if (!group->set->tables[level] && !pace_ask(step->pace, 0.0))
                    return NULL;
                const struct step_table *table = oscillators_table(group->set, level);
                if (!table)
                    return NULL;
                if (pa && pb)
                    kernel_response(table, group->stride, pa, pb, m);
            }
            /* W, the residual and the modes' products are symmetric */
            if (a != b)
                memcpy(all[b * n + a], m, sizeof all[b * n + a]);
        }
    }
    step->coupling[level] = all;
    return (const double(*)[NODES][NODES])all;
}

/* Approach at the nodes if no force acted on this step. */
static void free_approach(const struct scene *scene, const struct motion *motion, size_t contact,
                          int level, double approach[NODES])
{
    double h = step_length(level);
    double modes[NODES] = {0};
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        if (group->participation[contact])
            kernel_nodes(group->set->tables[level], group->stride, group->participation[contact],
                         motion->q[g], motion->v[g], modes);
    }
    for (int i = 0; i < NODES; i++) {
        double t = collocation.node[i] * h;
        double a = scene->gap_acceleration[contact];
        approach[i] =
            -(motion->gap[contact] + t * (motion->gap_rate[contact] + 0.5 * a * t)) - modes[i];
    }
}

static size_t active_list(const struct scene *scene, const bool *active, size_t *list)
{
    size_t count = 0;
    for (size_t c = 0; c < scene->contacts; c++)
        if (active[c])
            list[count++] = c;
    return count;
}

static void push_rigid(struct contact_step *step, const struct scene *scene, const size_t *list,
                       size_t count, double h)
{
    for (size_t b = 0; b < count; b++) {
        double impulse = 0.0;
        double travel = 0.0;
        for (int j = 0; j < NODES; j++) {
            impulse += h * collocation.weight[j] * step->force[list[b]][j];
            travel += h * h * collocation.position_end[j] * step->force[list[b]][j];
        }
        for (size_t a = 0; a < scene->contacts; a++) {
            step->end.gap[a] += scene->w[a * scene->contacts + list[b]] * travel;
            step->end.gap_rate[a] += scene->w[a * scene->contacts + list[b]] * impulse;
        }
    }
}

/* What the dampers of one group take, by the quadratic form of its table. */
static double group_loss(const struct contact_step *step, const struct scene_group *group,
                         const double *const state[2], const size_t *list, size_t count, int level)
{
    struct kernel_load loads[PERCUSS_MAX_CONTACTS];
    size_t used = 0;
    for (size_t b = 0; b < count; b++)
        if (group->participation[list[b]])
            loads[used++] =
                (struct kernel_load){group->participation[list[b]], step->force[list[b]]};
    return kernel_loss(group->set->tables[level], group->stride, state, loads, used);
}

/* Many contacts of a group are open most of the time. */
static bool bears_force(const double force[NODES])
{
    for (int j = 0; j < NODES; j++)
        if (force[j] != 0.0)
            return true;
    return false;
}

double contact_step_loss(const struct scene *scene, const struct motion *motion, int level,
                         double force[1][NODES])
{
    const size_t contact = 0;
    struct contact_step step = {.force = force};
    double sum = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        if (group->set->damping > 0.0)
            sum += group_loss(&step, group, (const double *const[]){motion->q[g], motion->v[g]},
                              &contact, 1, level);
    }
    return sum;
}

static void advance(struct contact_step *step, const struct scene *scene,
                    const struct motion *motion, const size_t *list, size_t count, int level)
{
    double h = step_length(level);
    step->end.time = motion->time + h;
    for (size_t c = 0; c < scene->contacts; c++) {
        double a = scene->gap_acceleration[c];
        step->end.gap[c] = motion->gap[c] + h * (motion->gap_rate[c] + 0.5 * a * h);
        step->end.gap_rate[c] = motion->gap_rate[c] + a * h;
    }
    push_rigid(step, scene, list, count, h);
    step->loss = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const struct step_table *table = group->set->tables[level];
        kernel_advance(table, group->stride, motion->q[g], motion->v[g], step->end.q[g],
                       step->end.v[g]);
        for (size_t b = 0; b < count; b++)
            if (group->participation[list[b]] && bears_force(step->force[list[b]]))
                kernel_push(table, group->stride, group->participation[list[b]],
                            step->force[list[b]], step->end.q[g], step->end.v[g]);
        if (group->set->damping > 0.0)
            step->loss +=
                group_loss(step, group, (const double *const[]){motion->q[g], motion->v[g]}, list,
                           count, level);
    }
}

/* One contact: Newton's method for d + c F(d) = approach. */
static bool local_of_one(const struct contact_law *law, double c, double approach,
                         double *indentation, double *force)
{
    double d = *indentation;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        double stiffness;
        *force = contact_law_force(law, d, &stiffness);
        double change = (d + c * *force - approach) / (1.0 + c * stiffness);
        d -= change;
        /* quadratic in the indentation, or down to the approach's rounding */
        if (fabs(change) <= 1e-7 * fabs(d) || fabs(change) <= 1e-15 * fabs(approach)) {
            *force = fmax(0.0, *force - stiffness * change);
            *indentation = d;
            return true;
        }
    }
    return false;
}

static bool local_of_many(const struct scene *scene, const size_t *list, size_t count,
                          const double *approach, double *indentation, double *force,
                          double *matrix)
{
    size_t n = scene->contacts;
    double unknown[PERCUSS_MAX_CONTACTS];
    double stiffness[PERCUSS_MAX_CONTACTS];
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        double change = 0.0;
        double scale = 0.0;
        for (size_t a = 0; a < count; a++)
            force[list[a]] =
                contact_law_force(&scene->laws[list[a]], indentation[list[a]], &stiffness[a]);
        for (size_t a = 0; a < count; a++) {
            unknown[a] = indentation[list[a]] - approach[list[a]];
            for (size_t b = 0; b < count; b++) {
                double c = scene->residual[list[a] * n + list[b]];
                unknown[a] += c * force[list[b]];
                matrix[a * count + b] = c * stiffness[b] + (a == b);
            }
        }
        if (!linear_solve(count, matrix, unknown))
            return false;
        for (size_t a = 0; a < count; a++) {
            indentation[list[a]] -= unknown[a];
            change = fmax(change, fabs(unknown[a]));
            scale = fmax(scale, fmax(fabs(indentation[list[a]]), fabs(approach[list[a]])));
        }
        if (change <= (iteration + 1 < MAX_ITERATIONS ? 1e-14 : 1e-9) * scale)
            return true;
    }
    return false;
}

bool contact_bears(const struct scene *scene, size_t contact, double stiffness)
{
    return -scene->residual[contact * (scene->contacts + 1)] * stiffness < 0.5;
}

bool contact_local_indentation(const struct scene *scene, const bool *active,
                               const double *approach, double *indentation, double *force,
                               double *matrix)
{
    size_t n = scene->contacts;
    size_t list[PERCUSS_MAX_CONTACTS];
    size_t count = active_list(scene, active, list);
    memset(force, 0, n * sizeof *force);
    bool solved = count == 0;
    if (count == 1) {
        size_t c = list[0];
        solved = local_of_one(&scene->laws[c], scene->residual[c * n + c], approach[c],
                              &indentation[c], &force[c]);
    }
    if (!solved)
        solved = local_of_many(scene, list, count, approach, indentation, force, matrix);
    for (size_t a = 0; a < n; a++) {
        if (active[a])
            continue;
        indentation[a] = approach[a];
        for (size_t b = 0; b < count; b++)
            indentation[a] -= scene->residual[a * n + list[b]] * force[list[b]];
    }
    return solved;
}

bool contact_step_solve(struct contact_step *step, const struct scene *scene,
                        const struct motion *motion, const bool *active, int level,
                        const struct contact_start *start)
{
    double h = step_length(level);
    const double(*coupling)[NODES][NODES] = coupling_of_level(step, scene, level);
    if (!coupling)
        return false;
    size_t list[PERCUSS_MAX_CONTACTS];
    size_t count = active_list(scene, active, list);
    for (size_t a = 0; a < count; a++) {
        const struct contact_start *from = &start[list[a]];
        free_approach(scene, motion, list[a], level, step->target[a]);
        for (int i = 0; i < NODES; i++) {
            double t = collocation.node[i] * h;
            step->indentation[list[a]][i] =
                from->indentation +
                t * (from->rate + t * (0.5 * from->curvature + t / 6.0 * from->bend));
        }
    }
    struct node_problem problem = {
        .laws = scene->laws,
        .contacts = scene->contacts,
        .list = list,
        .count = count,
        .coupling = coupling,
        .target = (const double(*)[NODES])step->target,
        .matrix = step->matrix,
        .residual = step->residual,
        .last_change = node_solver_last_change(step->accuracy),
    };
    if (!node_solve(&problem, step->indentation, step->force, step->stiffness, &step->iterations))
        return false;
    advance(step, scene, motion, list, count, level);
    double ignored;
    for (size_t c = 0; c < scene->contacts; c++) {
        motion_approach(&step->end, scene, c, &step->approach[c], &ignored);
        step->end_indentation[c] = active[c] ? collocation_value(step->indentation[c], 1.0) : 0.0;
    }
    return contact_local_indentation(scene, active, step->approach, step->end_indentation,
                                     step->end_force, step->matrix);
}
