/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/contact_step.h"

#include <math.h>
#include <string.h>

#include "impact/kernel.h"
#include "impact/node_solver.h"
#include "numeric/linear.h"

/* Newton's method takes two to five iterations, and some ten from a bad start. */
enum { MAX_ITERATIONS = 40 };

/* One contact: its method squares the relative change, so that after this one rounding is left. */
static const double SQUARES_TO_ROUNDING = 1e-7;
/* What rounding leaves of an approach, which can be far larger than the indentation. */
static const double APPROACH_ROUNDING = 1e-15;

/* Several contacts: change of the indentations over their largest, or over the largest approach,
 * which is some ten roundings; and what is accepted where the law's kinks keep it from that. */
static const double TO_ROUNDING = 1e-14;
static const double AFTER_ALL = 1e-9;

/* Share of the law's compliance that a negative series compliance may take away. */
static const double BEARABLE = 0.5;

bool contact_step_create(struct contact_step *step, const struct scene *scene, double accuracy,
                         struct arena *arena)
{
    size_t n = scene->contacts;
    size_t unknowns = n * NODES;
    *step = (struct contact_step){.arena = arena, .last_change = node_solver_last_change(accuracy)};
    step->indentation = arena_take(arena, n, sizeof *step->indentation);
    step->force = arena_take(arena, n, sizeof *step->force);
    step->stiffness = arena_take(arena, n, sizeof *step->stiffness);
    step->end_indentation = arena_take(arena, n, sizeof(double));
    step->matrix = arena_take(arena, unknowns * unknowns, sizeof(double));
    step->excess = arena_take(arena, unknowns, sizeof(double));
    step->target = arena_take(arena, n, sizeof *step->target);
    step->approach = arena_take(arena, n, sizeof(double));
    step->end_force = arena_take(arena, n, sizeof(double));
    return step->indentation && step->force && step->stiffness && step->end_indentation &&
           step->matrix && step->excess && step->target && step->approach && step->end_force &&
           carrier_create(&step->carrier, scene, arena);
}

/* What a unit force of contact b at node j does to the approach of contact a at node i, with the
 * residual flexibility: rigid double integral, modes, and the series compliance at the same node;
 * and to the approach at the end, without that compliance. OK, INTERNAL without memory, TIMEOUT
 * where the pace stopped it. */
static enum percuss_status find_coupling(struct contact_step *step, const struct scene *scene,
                                         int level)
{
    size_t n = scene->contacts;
    double h = step_length(level);
    /* the modes' tables */
    enum percuss_status status = scene_prepare(scene, level, step->pace);
    if (status != PERCUSS_OK)
        return status;
    double(*all)[STEP_POINTS][NODES] = arena_take(step->arena, n * n, sizeof *all);
    if (!all)
        return PERCUSS_INTERNAL;
    /* pairs of contacts */
    for (size_t a = 0; a < n; a++) {
        for (size_t b = 0; b <= a; b++) {
            double(*m)[NODES] = all[a * n + b];
            /* the rigid bodies, and the series compliance */
            for (int j = 0; j < NODES; j++)
                m[NODES][j] = scene->w[a * n + b] * h * h * collocation.position_end[j];
            for (int i = 0; i < NODES; i++) {
                for (int j = 0; j < NODES; j++)
                    m[i][j] = scene->w[a * n + b] * h * h * collocation.position[i][j];
                m[i][i] += scene->residual[a * n + b];
            }
            /* the modes that move both */
            for (size_t g = 0; g < scene->groups; g++) {
                const struct scene_group *group = &scene->group[g];
                const double *pa = group->participation[a];
                const double *pb = group->participation[b];
                if (pa && pb)
                    kernel_response(group->set->tables[level], group->stride, pa, pb, m);
            }
            /* W, the residual flexibility and the modes' products are symmetric */
            if (a != b)
                memcpy(all[b * n + a], m, sizeof all[b * n + a]);
        }
    }
    step->coupling[level] = all;
    return PERCUSS_OK;
}

/* Approaches at the nodes and the end if no force acted on this step. */
static void free_approaches(struct contact_step *step, const struct scene *scene,
                            const struct motion *motion, int level)
{
    double h = step_length(level);
    carrier_enter(&step->carrier, scene, motion, level, step->target);
    for (size_t c = 0; c < scene->contacts; c++) {
        double *target = step->target[c];
        double gap = motion->gap[c];
        double travel = h * motion->gap_rate[c];
        double bend = 0.5 * h * h * scene->gap_acceleration[c];
        for (int i = 0; i < NODES; i++) {
            double s = collocation.node[i];
            target[i] = -(gap + s * (travel + s * bend)) - target[i];
        }
        target[NODES] = -(gap + (travel + bend)) - target[NODES];
    }
}

/* Approach at the end of the step under its forces. */
static double end_approach(const struct contact_step *step, const struct scene *scene,
                           size_t contact, int level)
{
    double approach = step->target[contact][NODES];
    for (size_t b = 0; b < scene->contacts; b++) {
        const double *to_end = step->coupling[level][contact * scene->contacts + b][NODES];
        const double *force = step->force[b];
        approach -= (to_end[0] * force[0] + to_end[1] * force[1]) +
                    (to_end[2] * force[2] + to_end[3] * force[3]);
    }
    return approach;
}

void contact_step_take(struct contact_step *step, const struct scene *scene, struct motion *motion)
{
    carrier_take(&step->carrier, scene, motion, step->force);
}

void contact_step_leave(struct contact_step *step, const struct scene *scene, struct motion *motion)
{
    carrier_leave(&step->carrier, scene, motion);
}

double contact_step_loss(const struct scene *scene, const struct motion *motion, int level,
                         double (*const force)[NODES])
{
    struct kernel_load loads[PERCUSS_MAX_CONTACTS];
    double sum = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        size_t used = 0;
        if (!(group->set->most_damping > 0.0))
            continue;
        for (size_t c = 0; c < scene->contacts; c++)
            if (group->participation[c])
                loads[used++] = (struct kernel_load){group->participation[c], force[c]};
        sum += kernel_loss(group->set->tables[level], group->stride,
                           (const double *const[]){motion->q[g], motion->v[g]}, loads, used);
    }
    return sum;
}

/* One contact: Newton's method for d + c F(d) = approach, until a relative change below `last`. */
static bool local_of_one(const struct contact_law *law, double c, double approach, double last,
                         double *indentation, double *force)
{
    double d = *indentation;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        double stiffness;
        *force = contact_law_force(law, d, &stiffness);
        double change = (d + c * *force - approach) / (1.0 + c * stiffness);
        d -= change;
        if (fabs(change) <= last * fabs(d) || fabs(change) <= APPROACH_ROUNDING * fabs(approach)) {
            *force -= stiffness * change;
            *force = *force > 0.0 ? *force : 0.0;
            *indentation = d;
            return true;
        }
    }
    return false;
}

static inline double larger(double a, double b)
{
    return b > a || isnan(b) ? b : a;
}

/* All contacts at once: Newton's method for d_a + sum_b C_ab F_b(d_b) = approach_a. */
static bool local_of_many(const struct scene *scene, const double *approach, double *indentation,
                          double *force, double *matrix)
{
    size_t n = scene->contacts;
    double excess[PERCUSS_MAX_CONTACTS];
    double stiffness[PERCUSS_MAX_CONTACTS];
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        double change = 0.0;
        double scale = 0.0;
        bool squared = true; /* what is left are squares of changes, which are rounding */
        /* the excess e, and the matrix 1 + C F' */
        for (size_t c = 0; c < n; c++)
            force[c] = contact_law_force(&scene->laws[c], indentation[c], &stiffness[c]);
        for (size_t a = 0; a < n; a++) {
            excess[a] = indentation[a] - approach[a];
            for (size_t b = 0; b < n; b++) {
                double c = scene->residual[a * n + b];
                excess[a] += c * force[b];
                matrix[a * n + b] = c * stiffness[b] + (a == b);
            }
        }
        if (!linear_solve(n, matrix, excess))
            return false;
        /* the update, and whether it was the last one */
        for (size_t c = 0; c < n; c++) {
            indentation[c] -= excess[c];
            squared = squared && fabs(excess[c]) <= SQUARES_TO_ROUNDING * fabs(indentation[c]);
            change = larger(change, fabs(excess[c]));
            scale = larger(scale, larger(fabs(indentation[c]), fabs(approach[c])));
        }
        if (squared ||
            change <= (iteration + 1 < MAX_ITERATIONS ? TO_ROUNDING : AFTER_ALL) * scale) {
            for (size_t c = 0; c < n; c++)
                force[c] = larger(0.0, force[c] - stiffness[c] * excess[c]);
            return true;
        }
    }
    return false;
}

bool contact_bears(const struct scene *scene, size_t contact, double stiffness)
{
    return -scene->residual[contact * (scene->contacts + 1)] * stiffness < BEARABLE;
}

bool contact_local_indentation(const struct scene *scene, const double *approach,
                               double *indentation, double *force, double *matrix)
{
    if (scene->contacts == 1 && local_of_one(&scene->laws[0], scene->residual[0], approach[0],
                                             SQUARES_TO_ROUNDING, &indentation[0], &force[0]))
        return true;
    return local_of_many(scene, approach, indentation, force, matrix);
}

/* Indentations at the nodes as the step before has it: a Taylor series. */
static void foresee(struct contact_step *step, size_t contact, const struct contact_start *from,
                    double h)
{
    double *to = step->indentation[contact];
    double indentation = from->indentation;
    double rate = from->rate * h;
    double curvature = 0.5 * from->curvature * (h * h);
    double bend = from->bend * (h * h * h) * (1.0 / 6.0);
    for (int i = 0; i < NODES; i++) {
        double s = collocation.node[i];
        to[i] = indentation + s * (rate + s * (curvature + s * bend));
    }
}

/* The contacts at the end of the step, from where the cubics end: one contact as exactly as its
 * nodes, several to rounding. */
static bool find_end(struct contact_step *step, const struct scene *scene, int level)
{
    for (size_t c = 0; c < scene->contacts; c++) {
        const double *at_end = collocation.end[0];
        const double *d = step->indentation[c];
        step->approach[c] = end_approach(step, scene, c, level);
        step->end_indentation[c] =
            (at_end[0] * d[0] + at_end[1] * d[1]) + (at_end[2] * d[2] + at_end[3] * d[3]);
    }
    if (scene->contacts == 1 &&
        local_of_one(&scene->laws[0], scene->residual[0], step->approach[0], step->last_change,
                     step->end_indentation, step->end_force))
        return true;
    return contact_local_indentation(scene, step->approach, step->end_indentation, step->end_force,
                                     step->matrix);
}

enum contact_step_end contact_step_solve(struct contact_step *step, const struct scene *scene,
                                         const struct motion *motion, int level,
                                         const struct contact_start *start)
{
    /* a level that is new to the scene */
    if (!step->coupling[level]) {
        enum percuss_status status = find_coupling(step, scene, level);
        if (status != PERCUSS_OK)
            return status == PERCUSS_TIMEOUT ? STEP_STOPPED : STEP_MEMORY;
    }
    /* approaches without force, and starting values */
    free_approaches(step, scene, motion, level);
    for (size_t c = 0; c < scene->contacts; c++)
        foresee(step, c, &start[c], step_length(level));
    /* forces and indentations at the nodes */
    struct node_problem problem = {
        .laws = scene->laws,
        .contacts = scene->contacts,
        .coupling = (const double(*)[STEP_POINTS][NODES])step->coupling[level],
        .target = (const double(*)[STEP_POINTS])step->target,
        .matrix = step->matrix,
        .excess = step->excess,
        .last_change = step->last_change,
    };
    if (!node_solve(&problem, step->indentation, step->force, step->stiffness, &step->iterations))
        return STEP_UNSOLVED;
    if (step->carrier.damped)
        step->loss = contact_step_loss(scene, motion, level, step->force);
    return find_end(step, scene, level) ? STEP_SOLVED : STEP_UNSOLVED;
}
