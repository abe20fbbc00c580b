/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/node_solver.h"

#include <math.h>

#include "numeric/linear.h"

/* The nodes of a contact; the lanes' order of operations is that of scalars. */
typedef double quad __attribute__((vector_size(NODES * sizeof(double))));
typedef long long quad_mask __attribute__((vector_size(NODES * sizeof(long long))));

/* Newton's method takes two or three iterations in an ordinary step; where it takes so many it
 * would take for ever. */
enum { MAX_ITERATIONS = 40 };

/* A change below this share of the approaches, which can be far larger than the indentations in a
 * long contact, is their rounding. */
static const double ROUNDING = 1e-15;
/* Below this share a change that has stopped falling is rounding too, of sums of many terms. */
static const double ROUNDING_OF_SUMS = 1e-12;

/* Pivots, 1 where nothing couples, from which on elimination without exchanges loses a digit. */
static const double LEAST_PIVOT = 0.1;

/* A quad wherever it lies. */
typedef double loose_quad __attribute__((vector_size(NODES * sizeof(double)), aligned(8)));
#define QUAD(at)       (*(loose_quad *)(at))
#define CONST_QUAD(at) (*(const loose_quad *)(at))

/* A row and its right side less a multiple of another one. */
static inline void subtract(quad *row, double *right, double factor, const quad *other,
                            double other_right)
{
    *row -= factor * *other;
    *right -= factor * other_right;
}

/* Solves a x = b by elimination in the order given; the matrix is the identity plus a small causal
 * one. False: a pivot is too small for that order. */
static inline bool eliminate(const quad a[NODES], const double b[NODES], quad *x)
{
    quad r1 = a[1], r2 = a[2], r3 = a[3];
    double b1 = b[1], b2 = b[2], b3 = b[3];
    /* forward, without exchanges: a pivot that is too small spoils only what is thrown away */
    double p0 = 1.0 / a[0][0];
    subtract(&r1, &b1, r1[0] * p0, &a[0], b[0]);
    subtract(&r2, &b2, r2[0] * p0, &a[0], b[0]);
    subtract(&r3, &b3, r3[0] * p0, &a[0], b[0]);
    double p1 = 1.0 / r1[1];
    subtract(&r2, &b2, r2[1] * p1, &r1, b1);
    subtract(&r3, &b3, r3[1] * p1, &r1, b1);
    double p2 = 1.0 / r2[2];
    subtract(&r3, &b3, r3[2] * p2, &r2, b2);
    /* and back substitution */
    double x3 = b3 / r3[3];
    double x2 = (b2 - r2[3] * x3) * p2;
    double x1 = (b1 - r1[3] * x3 - r1[2] * x2) * p1;
    *x = (quad){(b[0] - a[0][3] * x3 - a[0][2] * x2 - a[0][1] * x1) * p0, x1, x2, x3};
    return a[0][0] > LEAST_PIVOT && r1[1] > LEAST_PIVOT && r2[2] > LEAST_PIVOT &&
           r3[3] > LEAST_PIVOT;
}

/* What an update changed, against the indentations and against the approaches without force: these
 * can be far larger in a long contact, and set the rounding. */
struct progress {
    double change, previous;
    double indentation, target;
};

/* fmax is a call; these are plain comparisons (a NaN change is caught by the caller's isfinite). */
static double larger(double a, double b)
{
    return b > a || isnan(b) ? b : a;
}

static void look_at(struct progress *progress, double change, double indentation, double target)
{
    progress->change = larger(progress->change, fabs(change));
    progress->indentation = larger(progress->indentation, fabs(indentation));
    progress->target = larger(progress->target, fabs(target));
}

/* Whether the iteration ends: the change was small enough for its square to be nothing, or was
 * rounding. */
static bool settled(const struct progress *progress, double last_change)
{
    return progress->change <= last_change * progress->indentation ||
           progress->change <= ROUNDING * progress->target ||
           (progress->change <= ROUNDING_OF_SUMS * progress->target &&
            progress->change >= progress->previous);
}

/* Forces after the last, tiny update: the slope that it was made with carries them along. */
static inline void follow(double force[NODES], const double stiffness[NODES], const quad *change)
{
    quad after = CONST_QUAD(force) - CONST_QUAD(stiffness) * *change;
    after = (quad)((quad_mask)after & (after > 0.0));
    QUAD(force) = after;
}

static inline double largest_of(const quad *values)
{
    double low = fabs((*values)[0]) > fabs((*values)[1]) ? fabs((*values)[0]) : fabs((*values)[1]);
    double high = fabs((*values)[2]) > fabs((*values)[3]) ? fabs((*values)[2]) : fabs((*values)[3]);
    return low > high ? low : high;
}

/* The excess e, and the matrix 1 + coupling F', row by row. */
static inline void assemble_one(const struct node_problem *problem, const quad *d,
                                const double force[NODES], const double stiffness[NODES],
                                quad matrix[NODES], double excess[NODES])
{
    const double(*m)[NODES] = problem->coupling[0];
    const quad forces = CONST_QUAD(force);
    const quad slopes = CONST_QUAD(stiffness);
    const quad bare = *d - CONST_QUAD(problem->target[0]);
    quad moved[NODES];
    for (int i = 0; i < NODES; i++)
        moved[i] = CONST_QUAD(m[i]) * forces;
    matrix[0] = CONST_QUAD(m[0]) * slopes + (quad){1.0, 0.0, 0.0, 0.0};
    matrix[1] = CONST_QUAD(m[1]) * slopes + (quad){0.0, 1.0, 0.0, 0.0};
    matrix[2] = CONST_QUAD(m[2]) * slopes + (quad){0.0, 0.0, 1.0, 0.0};
    matrix[3] = CONST_QUAD(m[3]) * slopes + (quad){0.0, 0.0, 0.0, 1.0};
    excess[0] = bare[0] + ((moved[0][0] + moved[0][2]) + (moved[0][1] + moved[0][3]));
    excess[1] = bare[1] + ((moved[1][0] + moved[1][2]) + (moved[1][1] + moved[1][3]));
    excess[2] = bare[2] + ((moved[2][0] + moved[2][2]) + (moved[2][1] + moved[2][3]));
    excess[3] = bare[3] + ((moved[3][0] + moved[3][2]) + (moved[3][1] + moved[3][3]));
}

/* One contact: the usual case, without scratch memory. */
static bool solve_one(const struct node_problem *problem, double indentation[NODES],
                      double force[NODES], double stiffness[NODES], unsigned long *iterations)
{
    const quad target = CONST_QUAD(problem->target[0]);
    quad d = CONST_QUAD(indentation);
    struct progress progress = {.previous = INFINITY, .target = largest_of(&target)};
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        quad matrix[NODES];
        double excess[NODES];
        quad change;
        contact_law_forces(problem->laws, indentation, force, stiffness);
        assemble_one(problem, &d, force, stiffness, matrix, excess);
        bool solved = eliminate(matrix, excess, &change);
        ++*iterations;
        /* the update, and whether it was the last one */
        d -= change;
        QUAD(indentation) = d;
        progress.change = largest_of(&change);
        progress.indentation = largest_of(&d);
        if (!solved || !isfinite((change[0] + change[1]) + (change[2] + change[3])))
            return false;
        if (settled(&progress, problem->last_change)) {
            follow(force, stiffness, &change);
            return true;
        }
        progress.previous = progress.change;
    }
    return false;
}

/* Newton's system of several contacts. An open contact bears no force and its indentation follows
 * from those of the pressed ones, so that only these are solved for. */
struct system {
    double (*stiffness)[NODES];                  /* [contact] */
    double change[PERCUSS_MAX_CONTACTS * NODES]; /* of the pressed ones */
    size_t pressed[PERCUSS_MAX_CONTACTS];        /* contacts */
    size_t pressed_count;
};

static void find_forces(const struct node_problem *problem, struct system *system,
                        double (*indentation)[NODES], double (*force)[NODES])
{
    system->pressed_count = 0;
    for (size_t c = 0; c < problem->contacts; c++) {
        bool presses = false;
        contact_law_forces(&problem->laws[c], indentation[c], force[c], system->stiffness[c]);
        for (int i = 0; i < NODES; i++)
            presses = presses || system->stiffness[c][i] != 0.0 || force[c][i] != 0.0;
        if (presses)
            system->pressed[system->pressed_count++] = c;
    }
}

/* The excess e of all contacts, and the matrix 1 + coupling F' of the pressed ones. */
static void assemble(const struct node_problem *problem, const struct system *system,
                     double (*indentation)[NODES], double (*force)[NODES])
{
    size_t n = problem->contacts;
    /* e_a = d_a - target_a + sum over the pressed b of coupling_ab F_b */
    for (size_t a = 0; a < n; a++)
        for (int i = 0; i < NODES; i++) {
            double sum = indentation[a][i] - problem->target[a][i];
            for (size_t q = 0; q < system->pressed_count; q++) {
                size_t b = system->pressed[q];
                const double(*m)[NODES] = problem->coupling[a * n + b];
                for (int j = 0; j < NODES; j++)
                    sum += m[i][j] * force[b][j];
            }
            problem->excess[a * NODES + (size_t)i] = sum;
        }
    /* rows and columns of the pressed ones */
    size_t size = system->pressed_count * NODES;
    for (size_t p = 0; p < system->pressed_count; p++)
        for (size_t q = 0; q < system->pressed_count; q++) {
            size_t b = system->pressed[q];
            const double(*m)[NODES] = problem->coupling[system->pressed[p] * n + b];
            for (size_t i = 0; i < NODES; i++) {
                double *row = problem->matrix + (p * NODES + i) * size + q * NODES;
                for (size_t j = 0; j < NODES; j++)
                    row[j] = m[i][j] * system->stiffness[b][j] + (p == q && i == j);
            }
        }
}

/* Turns the excess into the changes of all indentations: of the pressed ones by their system, of
 * an open one a: change_a = e_a - sum over the pressed b of coupling_ab F'_b change_b. */
static bool find_changes(const struct node_problem *problem, struct system *system)
{
    size_t n = problem->contacts;
    bool open[PERCUSS_MAX_CONTACTS];
    /* the pressed ones by their system */
    for (size_t a = 0; a < n; a++)
        open[a] = true;
    for (size_t p = 0; p < system->pressed_count; p++) {
        open[system->pressed[p]] = false;
        for (size_t i = 0; i < NODES; i++)
            system->change[p * NODES + i] = problem->excess[system->pressed[p] * NODES + i];
    }
    if (!linear_solve(system->pressed_count * NODES, problem->matrix, system->change))
        return false;
    /* the open ones by what those change */
    for (size_t a = 0; a < n; a++) {
        for (size_t q = 0; open[a] && q < system->pressed_count; q++) {
            size_t b = system->pressed[q];
            const double(*m)[NODES] = problem->coupling[a * n + b];
            for (size_t i = 0; i < NODES; i++)
                for (size_t j = 0; j < NODES; j++)
                    problem->excess[a * NODES + i] -=
                        m[i][j] * system->stiffness[b][j] * system->change[q * NODES + j];
        }
    }
    /* the changes of the pressed ones beside them */
    for (size_t p = 0; p < system->pressed_count; p++)
        for (size_t i = 0; i < NODES; i++)
            problem->excess[system->pressed[p] * NODES + i] = system->change[p * NODES + i];
    return true;
}

bool node_solve(const struct node_problem *problem, double (*indentation)[NODES],
                double (*force)[NODES], double (*stiffness)[NODES], unsigned long *iterations)
{
    /* one contact by itself, unless that fails */
    if (problem->contacts == 1 &&
        solve_one(problem, indentation[0], force[0], stiffness[0], iterations))
        return true;
    /* any number: forces, Newton's system and its solution */
    struct system system;
    system.stiffness = stiffness; /* the rest is scratch */
    double previous = INFINITY;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        find_forces(problem, &system, indentation, force);
        assemble(problem, &system, indentation, force);
        if (!find_changes(problem, &system))
            return false;
        ++*iterations;
        /* the update, and whether it was the last one */
        struct progress progress = {.previous = previous};
        for (size_t row = 0; row < problem->contacts * NODES; row++) {
            double *d = &indentation[row / NODES][row % NODES];
            *d -= problem->excess[row];
            look_at(&progress, problem->excess[row], *d, problem->target[row / NODES][row % NODES]);
        }
        if (!isfinite(progress.change))
            return false;
        if (settled(&progress, problem->last_change)) {
            for (size_t c = 0; c < problem->contacts; c++) {
                const quad change = CONST_QUAD(problem->excess + c * NODES);
                follow(force[c], stiffness[c], &change);
            }
            return true;
        }
        previous = progress.change;
    }
    return false;
}
