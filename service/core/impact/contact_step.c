/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/contact_step.h"

#include <math.h>
#include <string.h>

#include "impact/kernel.h"
#include "impact/node_factors.h"
#include "impact/node_solver.h"
#include "numeric/linear.h"

/* Newton's method takes two to five iterations, and some ten from a bad start. */
enum { MAX_ITERATIONS = 40 };
/* Contact by contact takes some five; if it takes so many, all at once is cheaper. */
enum { MAX_APART = 20 };

/* One contact: Newton's method squares the relative change, which leaves rounding after this. */
static const double SQUARES_TO_ROUNDING = 1e-7;
/* Relative rounding of an approach, which can far exceed the indentation. */
static const double APPROACH_ROUNDING = 1e-15;

/* Several contacts: change of the indentations over the largest indentation or approach, some ten
 * roundings; and the limit after all iterations, where kinks of the law prevent that. */
static const double TO_ROUNDING = 1e-14;
static const double AFTER_ALL = 1e-9;

/* Share of the law's compliance that a negative series compliance may cancel. */
static const double BEARABLE = 0.5;

static inline double larger(double a, double b)
{
    return b > a || isnan(b) ? b : a;
}

/* What the rounds may leave of tangential forces, over their limits, by the accuracy's root: a
 * third of what the cells leave (friction_step.c); and the smallest: a cell's mean stiffness over a
 * short way is the quotient of two differences. */
static const double SLIDE_LEFT = 0.01;
static const double FINEST_SLIDE = 1e-8;
/* The same of plain friction, which has no cells, by the accuracy. */
static const double PLAIN_LEFT = 0.1;

bool contact_step_create(struct contact_step *step, const struct scene *scene, double accuracy,
                         struct arena *arena)
{
    size_t n = scene->rows;
    double slide = scene->plain ? PLAIN_LEFT * accuracy : SLIDE_LEFT * sqrt(accuracy);
    step->arena = arena;
    step->last_change = node_solver_last_change(accuracy);
    step->last_slide = larger(slide, FINEST_SLIDE);
    /* consecutive arrays of one type */
    step->indentation = arena_take(arena, 3 * n, sizeof *step->indentation);
    step->target = arena_take(arena, 2 * n, sizeof *step->target);
    step->approach = arena_take(arena, 4 * n, sizeof *step->approach);
    step->matrix = arena_reserve(arena, n * n, sizeof(double));
    if (!step->indentation || !step->target || !step->approach || !step->matrix)
        return false;
    if (scene->frictions) {
        step->change = arena_take(arena, n, sizeof *step->change);
        step->friction = arena_take(arena, 1, sizeof *step->friction);
        if (!step->change || !step->friction ||
            !friction_step_create(step->friction, scene, accuracy, arena))
            return false;
    }
    step->force = step->indentation + n;
    step->stiffness = step->force + n;
    step->taken = step->target + n;
    step->end_force = step->approach + n;
    step->end_indentation = step->end_force + n;
    step->base = step->end_indentation + n;
    return way_step_create(&step->way, scene, arena) &&
           coupling_create(&step->coupling, scene, arena) &&
           midpoint_create(&step->midpoint, scene, arena);
}

/* Approaches at the nodes and the end if no force acted on this step. */
static void free_approaches(struct contact_step *step, const struct scene *scene,
                            const struct motion *motion, int level)
{
    double h = step_length(level);
    midpoint_enter(&step->midpoint, scene, motion, level, step->target);
    for (size_t c = 0; c < scene->rows; c++) {
        double *target = step->target[c];
        double gap = motion->gap[c];
        double travel = h * motion->gap_rate[c];
        double bend = 0.5 * h * h * scene->gap_acceleration[c];
#pragma GCC unroll 2
        for (int i = 0; i < NODES; i += 2) {
            node_pair s = NODE_CONST_PAIR(collocation.node + i);
            NODE_PAIR(target + i) = -(gap + s * (travel + s * bend)) - NODE_CONST_PAIR(target + i);
        }
        target[NODES] = -(gap + (travel + bend)) - target[NODES];
    }
}

/* The friction's histories go on from the end, too. Of plain friction only the changes of d count:
 * it begins anew at each step until the phase ends, so that they lose no digits to the way so far.
 */
NOT_INLINE static void take_with_friction(struct contact_step *step, const struct scene *scene,
                                          struct motion *motion)
{
    midpoint_take(&step->midpoint, scene, motion, step->force);
    friction_step_take(step->friction, scene, step->level, step->force, step->end_force);
    for (size_t row = scene->contacts; scene->plain && row < scene->rows; row++) {
        motion->gap[row] += step->end_indentation[row];
        step->base[row] += step->end_indentation[row];
        step->end_indentation[row] = 0.0;
    }
}

void contact_step_take(struct contact_step *step, const struct scene *scene, struct motion *motion)
{
    if (scene->frictions)
        take_with_friction(step, scene, motion);
    else
        midpoint_take(&step->midpoint, scene, motion, step->force);
}

void contact_step_leave(struct contact_step *step, const struct scene *scene, struct motion *motion)
{
    midpoint_leave(&step->midpoint, scene, motion);
    for (size_t row = scene->contacts; scene->plain && row < scene->rows; row++) {
        motion->gap[row] -= step->base[row];
        step->base[row] = 0.0;
    }
}

double contact_step_loss(const struct scene *scene, const struct motion *motion, int level,
                         double (*const force)[NODES])
{
    struct kernel_load loads[SCENE_MOST_ROWS];
    double sum = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        size_t used = 0;
        if (!(group->set->most_damping > 0.0))
            continue;
        for (size_t c = 0; c < scene->rows; c++)
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

/* Reductions of the approaches by other contacts' forces. */
static void take_residual(const struct scene *scene, const double *force, double *taken)
{
    size_t n = scene->contacts;
    memset(taken, 0, n * sizeof *taken);
    for (size_t b = 0; b < n; b++) {
        const double *by = scene->residual + b * scene->rows; /* symmetric */
        if (force[b] == 0.0)
            continue;
        for (size_t a = 0; a < n; a++)
            taken[a] += by[a] * force[b];
        taken[b] -= by[b] * force[b];
    }
}

/* Several contacts: Newton's method for d_a + sum_b C_ab F_b(d_b) = approach_a, each with the
 * others' forces fixed, until a relative change of the pressed ones below `last`. It converges
 * linearly. False: too slowly. */
static bool local_apart(const struct scene *scene, const double *approach, double last,
                        double *indentation, double *force)
{
    size_t n = scene->contacts;
    double taken[PERCUSS_MAX_CONTACTS];
    double stiffness[PERCUSS_MAX_CONTACTS];
    double change[PERCUSS_MAX_CONTACTS];
    double previous = INFINITY;
    double share = 0.0; /* ratio of the last two changes */
    for (int iteration = 0; iteration < MAX_APART; iteration++) {
        double largest = 0.0;
        double scale = 0.0;
        double reach = 0.0;
        for (size_t c = 0; c < n; c++)
            force[c] = contact_law_force(&scene->laws[c], indentation[c], &stiffness[c]);
        take_residual(scene, force, taken);
        /* the update, and whether it was the last one */
        for (size_t c = 0; c < n; c++) {
            double own = scene->residual[c * (scene->rows + 1)];
            change[c] = (indentation[c] + own * force[c] + taken[c] - approach[c]) /
                        (1.0 + own * stiffness[c]);
            indentation[c] -= change[c];
            reach = larger(reach, larger(fabs(indentation[c]), fabs(approach[c])));
            if (!(force[c] > 0.0 || indentation[c] > 0.0 || isnan(change[c])))
                continue;
            largest = larger(largest, fabs(change[c]));
            scale = larger(scale, fabs(indentation[c]));
        }
        double left = largest * (isfinite(previous) ? larger(share, largest / previous) : 1.0);
        if ((largest <= last * scale && left <= last * last * scale) ||
            largest <= TO_ROUNDING * reach) {
            for (size_t c = 0; c < n; c++)
                force[c] = larger(0.0, force[c] - stiffness[c] * change[c]);
            return true;
        }
        if (!(largest <= previous))
            return false;
        share = largest / previous;
        previous = largest;
    }
    return false;
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
        bool squared = true; /* the errors are squares of changes: rounding */
        /* the excess e, and the matrix 1 + C F' */
        for (size_t c = 0; c < n; c++)
            force[c] = contact_law_force(&scene->laws[c], indentation[c], &stiffness[c]);
        for (size_t a = 0; a < n; a++) {
            excess[a] = indentation[a] - approach[a];
            for (size_t b = 0; b < n; b++) {
                double c = scene->residual[a * scene->rows + b];
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
    return -scene->residual[contact * (scene->rows + 1)] * stiffness < BEARABLE;
}

/* Solves contact by contact to a relative change below `last`, or else all at once. */
static bool find_local(const struct scene *scene, const double *approach, double last,
                       double *indentation, double *force, double *matrix)
{
    double start[PERCUSS_MAX_CONTACTS];
    size_t size = scene->contacts * sizeof *start;
    memcpy(start, indentation, size);
    if (scene->contacts > 1 && local_apart(scene, approach, last, indentation, force))
        return true;
    memcpy(indentation, start, size);
    return local_of_many(scene, approach, indentation, force, matrix);
}

bool contact_local_indentation(const struct scene *scene, const double *approach,
                               double *indentation, double *force, double *matrix)
{
    if (scene->contacts == 1 && local_of_one(&scene->laws[0], scene->residual[0], approach[0],
                                             SQUARES_TO_ROUNDING, indentation, force))
        return true;
    return find_local(scene, approach, SQUARES_TO_ROUNDING, indentation, force, matrix);
}

/* Indentations at the nodes by the start's Taylor series. */
static void predict(struct contact_step *step, size_t contact, const struct contact_start *from,
                    double h)
{
    double *to = step->indentation[contact];
    double indentation = from->indentation;
    double rate = from->rate * h;
    double curvature = 0.5 * from->curvature * (h * h);
    double bend = from->bend * (h * h * h) * (1.0 / 6.0);
#pragma GCC unroll 2
    for (int i = 0; i < NODES; i += 2) {
        node_pair s = NODE_CONST_PAIR(collocation.node + i);
        NODE_PAIR(to + i) = indentation + s * (rate + s * (curvature + s * bend));
    }
}

/* Approaches at the step's end under its forces. */
static void find_approaches(struct contact_step *step, const struct scene *scene, int level)
{
    if (scene->rows == 1) {
        const double *m = coupling_own(&step->coupling, level, 0)->by[NODES];
        const double *force = step->force[0];
        step->approach[0] = step->target[0][NODES] - ((m[0] * force[0] + m[1] * force[1]) +
                                                      (m[2] * force[2] + m[3] * force[3]));
        return;
    }
    coupling_take_end(&step->coupling, scene, level, step->force, step->taken);
    for (size_t c = 0; c < scene->rows; c++)
        step->approach[c] = step->target[c][NODES] - step->taken[c][NODES];
}

/* Contacts whose force depends on their way were solved with the nodes. */
NOT_INLINE static bool end_way(struct contact_step *step, const struct scene *scene)
{
    for (size_t c = 0; c < scene->contacts; c++) {
        step->end_indentation[c] = step->way->contact[c].indentation[NODES];
        step->end_force[c] = step->way->contact[c].force[NODES];
    }
    return true;
}

/* Solves the contacts at the step's end for the approaches, from the values there are, as exactly
 * as the nodes. */
static inline bool find_end(struct contact_step *step, const struct scene *scene)
{
    if (step->way)
        return end_way(step, scene);
    if (scene->contacts == 1 &&
        local_of_one(&scene->laws[0], scene->residual[0], step->approach[0], step->last_change,
                     step->end_indentation, step->end_force))
        return true;
    return find_local(scene, step->approach, step->last_change, step->end_indentation,
                      step->end_force, step->matrix);
}

static void predict_all(struct contact_step *step, size_t contacts,
                        const struct contact_start *start, int level)
{
    for (size_t c = 0; c < contacts; c++)
        predict(step, c, &start[c], step_length(level));
}

/* Solves all at once, from the start again. */
NOT_INLINE static enum contact_step_end solve_together(struct contact_step *step,
                                                       const struct node_problem *problem,
                                                       const struct contact_start *start)
{
    size_t unknowns = problem->scene->contacts * NODES;
    if (!step->together)
        step->together = arena_reserve(step->arena, unknowns * unknowns, sizeof(double));
    if (!step->together)
        return STEP_MEMORY;
    predict_all(step, problem->scene->contacts, start, problem->level);
    return node_solve_together(problem, step->together, step->indentation, step->force,
                               step->stiffness, &step->iterations)
               ? STEP_SOLVED
               : STEP_UNSOLVED;
}

/* The tangents' part in what the contacts' own forces then reduce to d, and in the approaches,
 * which have the residual flexibility still. */
static void less_tangents(struct contact_step *step, const struct node_problem *problem)
{
    const struct scene *scene = problem->scene;
    memset(step->force, 0, scene->contacts * sizeof *step->force);
    coupling_take(problem->coupling, scene, problem->level, step->force, step->taken);
    for (size_t c = 0; c < scene->contacts; c++) {
        double *target = step->way->target[c], *approach = step->way->approach[c];
        for (int i = 0; i < STEP_POINTS; i++) {
            target[i] -= step->taken[c][i];
            approach[i] -= step->taken[c][i];
        }
        for (size_t row = scene->contacts; row < scene->rows; row++) {
            double residual = scene->residual[c * scene->rows + row];
            for (int i = 0; i < NODES; i++)
                approach[i] += residual * step->force[row][i];
            target[NODES] -= residual * collocation_last(step->force[row]);
        }
    }
}

/* Those of contacts whose force depends on their way. */
NOT_INLINE static enum contact_step_end solve_way(struct contact_step *step,
                                                  const struct node_problem *problem)
{
    struct way_step *way = step->way;
    size_t contacts = problem->scene->contacts;
    memcpy(way->target, problem->target, contacts * sizeof *way->target);
    memcpy(way->approach, problem->target, contacts * sizeof *way->approach);
    if (problem->scene->frictions)
        less_tangents(step, problem);
    if (!way_step_prepare(way, problem->level, step->arena))
        return STEP_MEMORY;
    if (!way_step_solve(way, problem->level, step->indentation, step->last_change,
                        &step->iterations))
        return STEP_UNSOLVED;
    for (size_t c = 0; c < contacts; c++) {
        const struct way_contact *contact = &way->contact[c];
        memcpy(step->indentation[c], contact->indentation, sizeof step->indentation[c]);
        memcpy(step->force[c], contact->force, sizeof step->force[c]);
        for (int i = 0; i < NODES; i++)
            step->stiffness[c][i] = contact->slope[i][i];
    }
    return STEP_SOLVED;
}

/* Forces and indentations of the normals at the nodes. */
static inline enum contact_step_end solve_normals(struct contact_step *step,
                                                  const struct node_problem *problem,
                                                  const struct contact_start *start)
{
    if (step->way)
        return solve_way(step, problem);
    if (node_solve(problem, step->indentation, step->force, step->stiffness, &step->iterations))
        return STEP_SOLVED;
    return solve_together(step, problem, start);
}

/* ---- Friction ---- */

/* The normal forces and the tangential ones in turn: one round in most steps and two where part of
 * the contact begins or ends to slide, as the tangents' own equations are solved by Newton's method
 * with the slopes of the cells, from forces that go on as on the step before. */
enum { MOST_ROUNDS = 30 };

/* What the first round leaves of a change by it. On steps of the paper's beam between the tangents
 * a second one found a fiftieth in the middle (the slopes' change on the way), a tenth at times;
 * contacts that share a body act on each other, which the slopes do not tell. */
static double first_leaves(const struct scene *scene)
{
    return scene->frictions == 1 ? 1.0 / 30.0 : 1.0;
}

/* A contact of a group whose limit is below this share of the group's need not be as exact: one far
 * from the impact may bear as good as nothing. */
static const double SHARE_OF_LIMITS = 0.01;

/* Of the forces along the tangents at a round's end: what it moves them by, and the limits. */
struct round_change {
    double moved[PERCUSS_MAX_CONTACTS], limit[PERCUSS_MAX_CONTACTS]; /* [friction], N */
};

/* The largest change over the limits. */
static double largest_change(const struct round_change *of, size_t count)
{
    double group = 0.0, largest = 0.0;
    for (size_t i = 0; i < count; i++)
        group = larger(group, SHARE_OF_LIMITS * of->limit[i]);
    for (size_t i = 0; i < count; i++)
        if (!(of->moved[i] == 0.0))
            largest = larger(largest, of->moved[i] / larger(of->limit[i], group));
    return largest;
}

/* Those of friction `i`. */
static void find_change(const struct contact_step *step, const struct scene *scene, size_t i,
                        struct round_change *of)
{
    const struct scene_friction *friction = &scene->friction[i];
    const double *normal = step->force[friction->contact];
    size_t row = scene_tangent(scene, i);
    of->limit[i] = of->moved[i] = 0.0;
    for (int j = 0; j < NODES; j++) {
        double moved = fabs(step->stiffness[row][j] * step->change[row][j]) +
                       fabs(step->stiffness[row + 1][j] * step->change[row + 1][j]);
        of->limit[i] = larger(of->limit[i], friction->coefficient * normal[j]);
        of->moved[i] = larger(of->moved[i], moved);
    }
}

static struct friction_way way_of(const struct contact_step *step, const struct scene *scene,
                                  size_t i, const struct contact_start *start)
{
    size_t row = scene_tangent(scene, i);
    size_t rows[3] = {scene->friction[i].contact, row, row + 1};
    struct friction_way way = {.time = step_length(step->level)};
    for (int r = 0; r < 3; r++) {
        way.start[r] = start[rows[r]].indentation;
        way.nodes[r] = step->indentation[rows[r]];
        way.end[r] = step->end_indentation[rows[r]];
    }
    return way;
}

/* The displacements of all tangents by the present forces. */
static void place_tangents(struct contact_step *step, const struct node_problem *problem)
{
    const struct scene *scene = problem->scene;
    coupling_take(problem->coupling, scene, problem->level, step->force, step->taken);
    for (size_t row = scene->contacts; row < scene->rows; row++)
        for (int i = 0; i < NODES; i++)
            step->indentation[row][i] = problem->target[row][i] - step->taken[row][i];
}

/* One round of Newton's method for the displacements of all tangents, each by itself:
 * d_t + sum coupling F = target. False: no solution. */
static bool improve_tangents(struct contact_step *step, const struct node_problem *problem)
{
    const struct scene *scene = problem->scene;
    coupling_take(problem->coupling, scene, problem->level, step->force, step->taken);
    for (size_t row = scene->contacts; row < scene->rows; row++) {
        const double(*m)[NODES] = coupling_own(problem->coupling, problem->level, row)->by;
        double excess[NODES];
        for (int i = 0; i < NODES; i++)
            excess[i] = step->indentation[row][i] - problem->target[row][i] + step->taken[row][i];
        if (!node_solve_linear(m, step->stiffness[row], excess, step->change[row]))
            return false;
        for (int i = 0; i < NODES; i++)
            step->indentation[row][i] -= step->change[row][i];
    }
    return true;
}

/* The forces at the nodes of friction `i` by the present indentations and displacements. */
static void walk_nodes(struct contact_step *step, const struct scene *scene, size_t i,
                       const struct contact_start *start)
{
    size_t row = scene_tangent(scene, i);
    const struct friction_way way = way_of(step, scene, i, start);
    friction_step_nodes(step->friction, i, &way, step->force[scene->friction[i].contact],
                        step->force + row, step->stiffness + row);
}

/* Shortens a tangential force to its limit. */
static void keep_limit(double *x, double *y, double limit)
{
    double square = *x * *x + *y * *y;
    if (square > limit * limit) {
        double part = limit / sqrt(square);
        *x *= part;
        *y *= part;
    }
}

/* Forces of friction `i` after the last, tiny change of its displacements, within their limit. */
static void follow_tangents(struct contact_step *step, const struct scene *scene, size_t i)
{
    const struct scene_friction *friction = &scene->friction[i];
    size_t row = scene_tangent(scene, i);
    for (int j = 0; j < NODES; j++) {
        double *x = &step->force[row][j], *y = &step->force[row + 1][j];
        double across = step->friction->across[i][j];
        double along_x = step->change[row][j], along_y = step->change[row + 1][j];
        *x -= step->stiffness[row][j] * along_x + across * along_y;
        *y -= step->stiffness[row + 1][j] * along_y + across * along_x;
        keep_limit(x, y, friction->coefficient * step->force[friction->contact][j]);
    }
}

/* Whether the tangents' forces leave the normal ones, which were solved before them, within `last`
 * of the contacts' forces. */
static bool normals_stay(struct contact_step *step, const struct node_problem *problem, double last)
{
    const struct scene *scene = problem->scene;
    double thrust[PERCUSS_MAX_CONTACTS], bears[PERCUSS_MAX_CONTACTS], group = 0.0;
    coupling_take(problem->coupling, scene, problem->level, step->force, step->taken);
    for (size_t c = 0; c < scene->contacts; c++) {
        thrust[c] = bears[c] = 0.0;
        for (int j = 0; j < NODES; j++) {
            double d = step->indentation[c][j];
            double excess = d - problem->target[c][j] + step->taken[c][j];
            if (d <= 0.0 && d - excess > 0.0) /* it closes */
                return false;
            thrust[c] = larger(thrust[c], fabs(step->stiffness[c][j] * excess));
            bears[c] = larger(bears[c], step->force[c][j]);
        }
        group = larger(group, SHARE_OF_LIMITS * bears[c]);
    }
    for (size_t c = 0; c < scene->contacts; c++)
        if (!(thrust[c] <= last * larger(bears[c], group)))
            return false;
    return true;
}

/* Rounds until the next one would move the forces by less than `last` of their limits, as this one
 * tells by what it leaves; they then follow the last change by their slopes. */
static enum contact_step_end solve_with_friction(struct contact_step *step,
                                                 const struct node_problem *problem,
                                                 const struct contact_start *start, double last)
{
    const struct scene *scene = problem->scene;
    size_t count = scene->frictions;
    double before = 0.0;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        struct round_change change;
        enum contact_step_end end = solve_normals(step, problem, start);
        if (end != STEP_SOLVED)
            return end;
        if (round == 0) {
            friction_step_predict(step->friction, scene, problem->level, step->force);
            place_tangents(step, problem);
        }
        for (size_t i = 0; i < count; i++)
            walk_nodes(step, scene, i, start);
        if (!improve_tangents(step, problem))
            return STEP_UNSOLVED;
        step->iterations++;
        for (size_t i = 0; i < count; i++)
            find_change(step, scene, i, &change);
        double moved = largest_change(&change, count);
        double leaves = round == 0 ? first_leaves(scene) : moved < before ? moved / before : 1.0;
        before = moved;
        if (!(moved * leaves <= last))
            continue;
        for (size_t i = 0; i < count; i++)
            follow_tangents(step, scene, i);
        if (normals_stay(step, problem, last))
            return STEP_SOLVED;
    }
    return STEP_UNSOLVED;
}

/* The approach of a row at the end less the residual flexibility's part by other rows' forces: of a
 * contact by the tangents', of a tangent by all. */
static double less_residual(const struct contact_step *step, const struct scene *scene, size_t row,
                            double approach)
{
    size_t rows = scene->rows;
    for (size_t b = row < scene->contacts ? scene->contacts : 0; b < rows; b++)
        if (b != row)
            approach -= scene->residual[row * rows + b] * step->end_force[b];
    return approach;
}

/* Newton's method for the displacements of friction `i` at the end, for the normal force there; the
 * forces follow. What it moves them by, over their limit. */
static double end_tangents(struct contact_step *step, const struct scene *scene, size_t i,
                           const struct contact_start *start)
{
    const struct scene_friction *friction = &scene->friction[i];
    size_t rows = scene->rows, row = scene_tangent(scene, i);
    double limit = friction->coefficient * step->end_force[friction->contact];
    double moved = 0.0, stiffness[2];
    const struct friction_way way = way_of(step, scene, i, start);
    friction_step_end(step->friction, i, &way, step->end_force[friction->contact],
                      step->end_force + row, stiffness);
    double excess[2];
    for (size_t j = 0; j < 2; j++)
        excess[j] = step->end_indentation[row + j] -
                    less_residual(step, scene, row + j, step->approach[row + j]) +
                    scene->residual[(row + j) * (rows + 1)] * step->end_force[row + j];
    for (size_t j = 0; j < 2; j++) {
        double own = scene->residual[(row + j) * (rows + 1)];
        double change = excess[j] / (1.0 + own * stiffness[j]);
        step->end_indentation[row + j] -= change;
        step->end_force[row + j] -= stiffness[j] * change;
        moved += fabs(stiffness[j] * change);
    }
    keep_limit(&step->end_force[row], &step->end_force[row + 1], limit);
    return moved > 0.0 ? moved / limit : 0.0;
}

/* Whether the tangents' forces at the end leave the contacts' approaches as they are solved, which
 * are `approach` without them. */
static bool normals_agree(const struct contact_step *step, const struct scene *scene,
                          const double *approach, double last)
{
    for (size_t c = 0; c < scene->contacts; c++) {
        double change = less_residual(step, scene, c, approach[c]) - step->approach[c];
        if (fabs(change) > last * fabs(step->end_indentation[c]))
            return false;
    }
    return true;
}

/* The displacements of the tangents at the end by the forces there. */
static void place_ends(struct contact_step *step, const struct scene *scene)
{
    for (size_t row = scene->contacts; row < scene->rows; row++)
        step->end_indentation[row] =
            less_residual(step, scene, row, step->approach[row]) -
            scene->residual[row * (scene->rows + 1)] * step->end_force[row];
}

/* Solves the step's end, as exactly as the nodes. */
static bool end_with_friction(struct contact_step *step, const struct scene *scene,
                              const struct contact_start *start, double last)
{
    size_t n = scene->contacts;
    double approach[PERCUSS_MAX_CONTACTS];
    memcpy(approach, step->approach, n * sizeof *approach);
    for (size_t row = n; row < scene->rows; row++)
        step->end_force[row] = collocation_last(step->force[row]);
    for (int round = 0; round < MOST_ROUNDS; round++) {
        double moved = 0.0;
        for (size_t c = 0; c < n; c++)
            step->approach[c] = less_residual(step, scene, c, approach[c]);
        if (!find_end(step, scene))
            return false;
        if (round == 0)
            place_ends(step, scene);
        for (size_t i = 0; i < scene->frictions; i++)
            moved = larger(moved, end_tangents(step, scene, i, start));
        if (moved * first_leaves(scene) <= last && normals_agree(step, scene, approach, last))
            return true;
    }
    return false;
}

/* ---- Plain friction ---- */

/* The size of the gaps and the modes' displacements that make up d. */
static void find_reaches(struct contact_step *step, const struct scene *scene,
                         const struct motion *motion)
{
    for (size_t i = 0; i < scene->frictions; i++) {
        size_t row = scene_tangent(scene, i);
        double reach = 0.0;
        for (size_t r = row; r < row + 2; r++)
            reach = larger(reach, fabs(motion->gap[r]) + fabs(step->target[r][NODES]));
        step->friction->coulomb.reach[i] = reach;
    }
}

/* The tangents' d at the nodes and the end under the present forces; the end's by their cubics. */
static void find_slides(struct contact_step *step, const struct node_problem *problem)
{
    const struct scene *scene = problem->scene;
    size_t rows = scene->rows;
    coupling_take(problem->coupling, scene, problem->level, step->force, step->taken);
    for (size_t row = scene->contacts; row < rows; row++) {
        const double *target = problem->target[row], *taken = step->taken[row];
        for (int i = 0; i < NODES; i++)
            step->indentation[row][i] = target[i] - taken[i];
        double end = target[NODES] - taken[NODES];
        for (size_t b = 0; b < rows; b++)
            end -= scene->residual[row * rows + b] * collocation_last(step->force[b]);
        step->end_indentation[row] = end;
    }
}

/* The forces of all tangents under those of the normals, contact by contact; their largest change
 * over their limits, NAN: no solution. */
static double slide_all(struct contact_step *step, const struct node_problem *problem,
                        const struct contact_start *start)
{
    const struct scene *scene = problem->scene;
    struct round_change of;
    for (size_t i = 0; i < scene->frictions; i++) {
        const struct scene_friction *friction = &scene->friction[i];
        const double *normal = step->force[friction->contact];
        double(*force)[NODES] = step->force + scene_tangent(scene, i);
        double before[2][NODES];
        memcpy(before, force, sizeof before);
        find_slides(step, problem);
        const struct friction_way way = way_of(step, scene, i, start);
        if (!coulomb_solve(&step->friction->coulomb, scene, i, problem->level, &way, normal, force))
            return NAN;
        double rounding = step->friction->coulomb.rounding[i];
        of.limit[i] = of.moved[i] = 0.0;
        for (int j = 0; j < NODES; j++) {
            of.limit[i] = larger(of.limit[i], friction->coefficient * normal[j]);
            double change = hypot(force[0][j] - before[0][j], force[1][j] - before[1][j]);
            of.moved[i] = larger(of.moved[i], change > rounding ? change : 0.0);
        }
    }
    return largest_change(&of, scene->frictions);
}

/* Sweeps over contacts that stick on one body each take a share of what the others leave. */
enum { MOST_SWEEPS = 200 };

/* As solve_with_friction. */
static enum contact_step_end solve_plain(struct contact_step *step,
                                         const struct node_problem *problem,
                                         const struct contact_start *start, double last)
{
    const struct scene *scene = problem->scene;
    size_t rows = scene->rows;
    double work = (double)(scene->frictions * rows * rows);
    if (!coulomb_prepare(&step->friction->coulomb, scene, problem->coupling, problem->level,
                         step->arena))
        return STEP_MEMORY;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        enum contact_step_end end = solve_normals(step, problem, start);
        if (end != STEP_SOLVED)
            return end;
        double first = slide_all(step, problem, start), change = first;
        for (int sweep = 0; scene->frictions > 1 && change > last && sweep < MOST_SWEEPS; sweep++) {
            if (!pace_keeps(step->pace, work))
                return STEP_STOPPED;
            change = slide_all(step, problem, start);
            step->iterations++;
        }
        if (isnan(change) || (scene->frictions > 1 && change > last))
            return STEP_UNSOLVED;
        step->iterations++;
        if (round > 0 && first <= last) {
            find_slides(step, problem);
            return STEP_SOLVED;
        }
    }
    return STEP_UNSOLVED;
}

/* The tangents' forces at the end are those of their last points. */
static bool end_plain(struct contact_step *step, const struct scene *scene,
                      const struct contact_start *start)
{
    for (size_t row = scene->contacts; row < scene->rows; row++)
        step->end_force[row] = collocation_last(step->force[row]);
    double approach[PERCUSS_MAX_CONTACTS];
    for (size_t c = 0; c < scene->contacts; c++)
        approach[c] = less_residual(step, scene, c, step->approach[c]);
    memcpy(step->approach, approach, scene->contacts * sizeof *approach);
    if (!find_end(step, scene))
        return false;
    place_ends(step, scene);
    for (size_t i = 0; i < scene->frictions; i++) {
        const struct friction_way way = way_of(step, scene, i, start);
        coulomb_end(&step->friction->coulomb, i, &way, step->force + scene_tangent(scene, i));
    }
    return true;
}

/* ---- A step ---- */

/* Forces and indentations at the nodes with friction. */
NOT_INLINE static enum contact_step_end solve_nodes(struct contact_step *step,
                                                    const struct node_problem *problem,
                                                    const struct motion *motion,
                                                    const struct contact_start *start)
{
    if (!problem->scene->plain)
        return solve_with_friction(step, problem, start, step->last_slide);
    find_reaches(step, problem->scene, motion);
    return solve_plain(step, problem, start, step->last_slide);
}

/* And at the end. */
NOT_INLINE static bool solve_end(struct contact_step *step, const struct scene *scene,
                                 const struct contact_start *start)
{
    return scene->plain ? end_plain(step, scene, start)
                        : end_with_friction(step, scene, start, step->last_slide);
}

enum contact_step_end contact_step_solve(struct contact_step *step, const struct scene *scene,
                                         const struct motion *motion, int level,
                                         const struct contact_start *start)
{
    size_t rows = scene->rows;
    /* a level that is new to the scene */
    if (!step->coupling.level[level]) {
        enum percuss_status status =
            coupling_prepare(&step->coupling, scene, level, step->arena, step->pace);
        if (status != PERCUSS_OK)
            return status == PERCUSS_TIMEOUT ? STEP_STOPPED : STEP_MEMORY;
    }
    /* approaches without force, and starting values */
    free_approaches(step, scene, motion, level);
    predict_all(step, rows, start, level);
    /* forces and indentations at the nodes */
    const struct node_problem problem = {
        .scene = scene,
        .coupling = &step->coupling,
        .level = level,
        .target = (const double(*)[STEP_POINTS])step->target,
        .taken = step->taken,
        .last_change = step->last_change,
    };
    step->level = level;
    enum contact_step_end end = scene->frictions ? solve_nodes(step, &problem, motion, start)
                                                 : solve_normals(step, &problem, start);
    if (end != STEP_SOLVED)
        return end;
    if (step->midpoint.damped)
        step->loss = contact_step_loss(scene, motion, level, step->force);
    /* and at the end, from the cubics' values */
    find_approaches(step, scene, level);
    for (size_t r = 0; r < rows; r++)
        step->end_indentation[r] = collocation_last(step->indentation[r]);
    bool ends = scene->frictions ? solve_end(step, scene, start) : find_end(step, scene);
    return ends ? STEP_SOLVED : STEP_UNSOLVED;
}
