/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/node_solver.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/extremes.h"
#include "base/vector_clones.h"
#include "impact/node_factors.h"
#include "impact/simd.h"
#include "numeric/linear.h"

/* Newton's method takes two or three iterations in an ordinary step; after so many it does not
 * converge. */
enum { MAX_ITERATIONS = 40 };

/* Contact by contact it takes some five. Where, after the first ones, the change falls by less than
 * to this share of the one before, solving all contacts at once is faster. */
enum { FIRST_ITERATIONS = 3, MAX_APART = 20 };
static const double SLOWEST = 0.5;

/* A change below this share of the approaches, which can be far larger than the indentations in a
 * long contact, is their rounding. */
static const double ROUNDING = 1e-15;
/* Below this share a change that has stopped falling is rounding too, of sums of many terms. */
static const double ROUNDING_OF_SUMS = 1e-12;

/* Solves a x = b. False: a pivot is too small for that order. */
static inline bool eliminate(const struct node_row a[NODES], const double b[NODES], double x[NODES])
{
    const struct node_factors factors = node_factors_make(a);
    node_factors_solve(&factors, b, x);
    return factors.sound;
}

/* The change of an update, the indentations and the approaches without force: these can be far
 * larger in a long contact, and set the rounding. */
struct progress {
    double change, previous;
    double share; /* `previous` over the change before it */
    double indentation, target;
};

/* Whether the iteration ends: the square of the change is negligible, or the change is rounding. */
static bool settled(const struct progress *progress, double last_change)
{
    return progress->change <= last_change * progress->indentation ||
           progress->change <= ROUNDING * progress->target ||
           (progress->change <= ROUNDING_OF_SUMS * progress->target &&
            progress->change >= progress->previous);
}

/* Forces after the last, tiny update, by the slope that the update used. */
static inline void follow(double force[NODES], const double stiffness[NODES],
                          const double change[NODES])
{
    for (int i = 0; i < NODES; i += 2) {
        node_pair after = NODE_CONST_PAIR(force + i) -
                          NODE_CONST_PAIR(stiffness + i) * NODE_CONST_PAIR(change + i);
        NODE_PAIR(force + i) = (node_pair)((pair_mask)after & (after > 0.0));
    }
}

static inline double largest_of(const double values[NODES])
{
    static const pair_mask MAGNITUDE = {INT64_MAX, INT64_MAX};
    pair_mask low = (pair_mask)NODE_CONST_PAIR(values) & MAGNITUDE;
    pair_mask high = (pair_mask)NODE_CONST_PAIR(values + 2) & MAGNITUDE;
    pair_mask above = (node_pair)low > (node_pair)high;
    node_pair most = (node_pair)((low & above) | (high & ~above));
    return most[0] > most[1] ? most[0] : most[1];
}

/* The excess e, and the matrix. */
static inline void assemble_one(const struct node_problem *problem, const double d[NODES],
                                const double force[NODES], const double stiffness[NODES],
                                struct node_row a[NODES], double excess[NODES])
{
    const double(*m)[NODES] = coupling_own(problem->coupling, problem->level, 0)->by;
    const double *target = problem->target[0];
#pragma GCC unroll 2
    for (int i = 0; i < NODES; i += 2) {
        node_pair one = node_row_of(m[i], force, stiffness, &a[i]);
        node_pair next = node_row_of(m[i + 1], force, stiffness, &a[i + 1]);
        NODE_PAIR(excess + i) =
            NODE_CONST_PAIR(d + i) - NODE_CONST_PAIR(target + i) + FOLD_BOTH(one, next);
    }
    node_rows_add_one(a);
}

/* One contact: the usual case, without scratch memory. */
static bool solve_one(const struct node_problem *problem, double d[NODES], double force[NODES],
                      double stiffness[NODES], unsigned long *iterations)
{
    struct progress progress = {.previous = INFINITY, .target = largest_of(problem->target[0])};
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        struct node_row matrix[NODES];
        double excess[NODES];
        double change[NODES];
        contact_law_forces(problem->scene->laws, d, force, stiffness);
        assemble_one(problem, d, force, stiffness, matrix, excess);
        bool solved = eliminate(matrix, excess, change);
        ++*iterations;
        /* the update, and whether it was the last one */
        for (int i = 0; i < NODES; i++)
            d[i] -= change[i];
        progress.change = largest_of(change);
        progress.indentation = largest_of(d);
        if (!solved || !isfinite((change[0] + change[1]) + (change[2] + change[3])))
            return false;
        if (settled(&progress, problem->last_change)) {
            follow(force, stiffness, change);
            return true;
        }
        progress.previous = progress.change;
    }
    return false;
}

/* The excess e of a contact at its nodes. */
static inline void find_excess(const struct node_problem *problem, size_t contact,
                               const double d[NODES], double excess[NODES])
{
    const double *target = problem->target[contact];
    const double *taken = problem->taken[contact];
    for (int i = 0; i < NODES; i++)
        excess[i] = d[i] - target[i] + taken[i];
}

static inline bool presses(const double force[NODES], const double stiffness[NODES])
{
    bool any = false;
    for (int i = 0; i < NODES; i++)
        any = any || force[i] != 0.0 || stiffness[i] != 0.0;
    return any;
}

bool node_solve_linear(const double (*m)[NODES], const double stiffness[NODES],
                       const double b[NODES], double x[NODES])
{
    struct node_row matrix[NODES];
    node_rows_make(m, stiffness, matrix);
    return eliminate(matrix, b, x);
}

/* One contact's change under the present forces of the others. */
static bool change_apart(const struct node_problem *problem, size_t contact, const double d[NODES],
                         const double stiffness[NODES], double change[NODES])
{
    const double(*m)[NODES] = coupling_own(problem->coupling, problem->level, contact)->by;
    double excess[NODES];
    find_excess(problem, contact, d, excess);
    return node_solve_linear(m, stiffness, excess, change);
}

/* Contacts that are open, and stay so, set no scale and need no accuracy. */
static void note_change(struct progress *progress, bool pressed, const double d[NODES],
                        const double change[NODES])
{
    if (!pressed && !(d[0] > 0.0 || d[1] > 0.0 || d[2] > 0.0 || d[3] > 0.0))
        return;
    progress->change = larger(progress->change, largest_of(change));
    progress->indentation = larger(progress->indentation, largest_of(d));
}

/* As settled, with the others' forces of the iteration before: the error falls by a share that is
 * no larger than those of the last two changes (two, as contacts can affect each other in turn). */
static bool settled_apart(const struct progress *progress, double last_change)
{
    double share = isfinite(progress->previous) ? progress->change / progress->previous : 1.0;
    double left = progress->change * larger(share, progress->share);
    return progress->change == 0.0 || (settled(progress, last_change) &&
                                       (left <= last_change * last_change * progress->indentation ||
                                        progress->change <= ROUNDING_OF_SUMS * progress->target));
}

/* The largest approach without force: it sets the rounding. */
static double largest_target(const struct node_problem *problem)
{
    double largest = 0.0;
    for (size_t c = 0; c < problem->scene->contacts; c++)
        largest = larger(largest, largest_of(problem->target[c]));
    return largest;
}

/* Several contacts, each by itself under the forces of the others. */
static bool solve_apart(const struct node_problem *problem, double (*d)[NODES],
                        double (*force)[NODES], double (*stiffness)[NODES],
                        unsigned long *iterations)
{
    size_t n = problem->scene->contacts;
    double change[PERCUSS_MAX_CONTACTS][NODES];
    struct progress progress = {.previous = INFINITY, .target = largest_target(problem)};
    for (int iteration = 0; iteration < MAX_APART; iteration++) {
        for (size_t c = 0; c < n; c++)
            contact_law_forces(&problem->scene->laws[c], d[c], force[c], stiffness[c]);
        coupling_take(problem->coupling, problem->scene, problem->level, force, problem->taken);
        ++*iterations;
        /* the update, and whether it was the last one */
        progress.change = progress.indentation = 0.0;
        for (size_t c = 0; c < n; c++) {
            bool pressed = presses(force[c], stiffness[c]);
            if (!pressed)
                find_excess(problem, c, d[c], change[c]);
            else if (!change_apart(problem, c, d[c], stiffness[c], change[c]))
                return false;
            for (int i = 0; i < NODES; i++)
                d[c][i] -= change[c][i];
            if (!isfinite((change[c][0] + change[c][1]) + (change[c][2] + change[c][3])))
                return false;
            note_change(&progress, pressed, d[c], change[c]);
        }
        if (settled_apart(&progress, problem->last_change)) {
            for (size_t c = 0; c < n; c++)
                follow(force[c], stiffness[c], change[c]);
            return true;
        }
        if (iteration >= FIRST_ITERATIONS && progress.change > SLOWEST * progress.previous)
            return false;
        progress.share = progress.change / progress.previous;
        progress.previous = progress.change;
    }
    return false;
}

bool node_solve(const struct node_problem *problem, double (*indentation)[NODES],
                double (*force)[NODES], double (*stiffness)[NODES], unsigned long *iterations)
{
    if (problem->scene->rows == 1)
        return solve_one(problem, indentation[0], force[0], stiffness[0], iterations);
    return solve_apart(problem, indentation, force, stiffness, iterations);
}

/* Newton's system of several contacts. An open contact bears no force and its indentation follows
 * from those of the pressed ones, so that only these are solved for. */
struct system {
    double *matrix;
    double right[PERCUSS_MAX_CONTACTS * NODES]; /* of the pressed ones */
    size_t pressed[PERCUSS_MAX_CONTACTS];       /* contacts */
    size_t count;
};

/* The matrix 1 + coupling F' of the pressed ones. */
static void assemble(const struct node_problem *problem, const struct system *system,
                     double (*const stiffness)[NODES])
{
    size_t size = system->count * NODES;
    for (size_t p = 0; p < system->count; p++)
        for (size_t q = 0; q < system->count; q++) {
            double by[STEP_POINTS][NODES];
            size_t b = system->pressed[q];
            coupling_between(problem->scene, problem->level, system->pressed[p], b, by);
            for (size_t i = 0; i < NODES; i++) {
                double *row = system->matrix + (p * NODES + i) * size + q * NODES;
                for (size_t j = 0; j < NODES; j++)
                    row[j] = by[i][j] * stiffness[b][j];
                row[i] += p == q ? 1.0 : 0.0;
            }
        }
}

/* Turns the excess into the changes of all indentations: of the pressed ones by their system, of
 * an open one a: change_a = e_a - sum over the pressed b of coupling_ab F'_b change_b. */
static bool find_changes(const struct node_problem *problem, struct system *system,
                         double (*const force)[NODES], double (*const stiffness)[NODES],
                         double (*change)[NODES])
{
    size_t n = problem->scene->contacts;
    double thrust[SCENE_MOST_ROWS][NODES] = {{0}};
    system->count = 0;
    for (size_t c = 0; c < n; c++)
        if (presses(force[c], stiffness[c]))
            system->pressed[system->count++] = c;
    /* the pressed ones, with exchanges of rows where it needs them */
    assemble(problem, system, stiffness);
    for (size_t p = 0; p < system->count; p++)
        memcpy(system->right + p * NODES, change[system->pressed[p]], sizeof *change);
    if (!linear_solve(system->count * NODES, system->matrix, system->right))
        return false;
    for (size_t p = 0; p < system->count; p++)
        for (size_t i = 0; i < NODES; i++)
            thrust[system->pressed[p]][i] =
                stiffness[system->pressed[p]][i] * system->right[p * NODES + i];
    /* all of them by the changes of those forces */
    coupling_take(problem->coupling, problem->scene, problem->level, thrust, problem->taken);
    for (size_t c = 0; c < n; c++)
        for (int i = 0; i < NODES; i++)
            change[c][i] -= problem->taken[c][i];
    return true;
}

bool node_solve_together(const struct node_problem *problem, double *matrix,
                         double (*indentation)[NODES], double (*force)[NODES],
                         double (*stiffness)[NODES], unsigned long *iterations)
{
    size_t n = problem->scene->contacts;
    double change[PERCUSS_MAX_CONTACTS][NODES];
    struct progress progress = {.previous = INFINITY, .target = largest_target(problem)};
    struct system system;
    system.matrix = matrix; /* the rest is scratch */
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        /* forces, the excess, Newton's system and its solution */
        for (size_t c = 0; c < n; c++)
            contact_law_forces(&problem->scene->laws[c], indentation[c], force[c], stiffness[c]);
        coupling_take(problem->coupling, problem->scene, problem->level, force, problem->taken);
        for (size_t c = 0; c < n; c++)
            find_excess(problem, c, indentation[c], change[c]);
        if (!find_changes(problem, &system, force, stiffness, change))
            return false;
        ++*iterations;
        /* the update, and whether it was the last one */
        progress.change = progress.indentation = 0.0;
        for (size_t c = 0; c < n; c++) {
            for (int i = 0; i < NODES; i++)
                indentation[c][i] -= change[c][i];
            if (!isfinite((change[c][0] + change[c][1]) + (change[c][2] + change[c][3])))
                return false;
            note_change(&progress, presses(force[c], stiffness[c]), indentation[c], change[c]);
        }
        if (progress.change == 0.0 || settled(&progress, problem->last_change)) {
            for (size_t c = 0; c < n; c++)
                follow(force[c], stiffness[c], change[c]);
            return true;
        }
        progress.previous = progress.change;
    }
    return false;
}

_Static_assert((int)NODE_LINEAR_RIGHT == (int)NODES, "a row's right sides are one of them");

void node_linear_fill(struct node_linear *linear, const struct coupling *coupling, int level,
                      double (*const stiffness)[NODES])
{
    for (size_t p = 0; p < linear->count; p++)
        for (size_t q = 0; q < linear->count; q++) {
            size_t b = linear->contact[q];
            const struct coupling_block *block =
                coupling_between_two(coupling, level, linear->contact[p], b);
            struct node_linear_row *row = linear->row + p * NODES;
            for (size_t i = 0; i < NODES; i++) {
                double *at = row[i].matrix + q * NODES;
                QUAD(at) = block ? CONST_QUAD(block->by[i]) * CONST_QUAD(stiffness[b]) : (quad){0};
                at[i] += p == q ? 1.0 : 0.0;
            }
        }
}

/* Eliminates column k from the rows below row k. */
static inline void take_out(struct node_linear *linear, size_t k, size_t rows)
{
    const struct node_linear_row *top = &linear->row[k];
    double inverse = 1.0 / top->matrix[k];
    for (size_t i = k + 1; i < rows; i++) {
        struct node_linear_row *row = &linear->row[i];
        double factor = row->matrix[k] * inverse;
        for (size_t j = k / NODES * NODES; j < rows; j += NODES)
            QUAD(row->matrix + j) -= factor * CONST_QUAD(top->matrix + j);
        QUAD(row->right) -= factor * CONST_QUAD(top->right);
    }
}

VECTOR_CLONES bool node_linear_solve(struct node_linear *linear)
{
    size_t rows = linear->count * NODES;
    for (size_t k = 0; k < rows; k++) {
        if (!(linear->row[k].matrix[k] > LEAST_PIVOT))
            return false;
        take_out(linear, k, rows);
    }
    /* and back substitution */
    for (size_t i = rows; i-- > 0;) {
        struct node_linear_row *row = &linear->row[i];
        quad sum = CONST_QUAD(row->right);
        for (size_t j = i + 1; j < rows; j++)
            sum -= row->matrix[j] * CONST_QUAD(linear->row[j].right);
        QUAD(row->right) = sum / row->matrix[i];
    }
    return true;
}
