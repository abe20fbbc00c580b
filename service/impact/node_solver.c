/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/node_solver.h"

#include <math.h>

#include "numeric/linear.h"

/* One row of a 4 x 4 system; the lanes' order of operations is that of scalars. */
typedef double quad __attribute__((vector_size(NODES * sizeof(double))));

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

/* Solves a x = b by elimination in the order given; the matrix is the identity plus a small causal
 * one. False: a pivot is too small for that order. */
static bool eliminate(quad a[NODES], double b[NODES])
{
    double inverse[NODES];
    /* forward, without exchanges */
    for (int c = 0; c < NODES; c++) {
        if (!(fabs(a[c][c]) > LEAST_PIVOT))
            return false;
        inverse[c] = 1.0 / a[c][c];
        for (int i = c + 1; i < NODES; i++) {
            double factor = a[i][c] * inverse[c];
            a[i] -= factor * a[c];
            b[i] -= factor * b[c];
        }
    }
    /* and back substitution */
    for (int i = NODES - 1; i >= 0; i--) {
        b[i] *= inverse[i];
        for (int k = 0; k < i; k++)
            b[k] -= a[k][i] * b[i];
    }
    return true;
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
static void follow(double force[NODES], const double stiffness[NODES], const double change[NODES])
{
    for (int i = 0; i < NODES; i++)
        force[i] = fmax(0.0, force[i] - stiffness[i] * change[i]);
}

/* One contact: the usual case, without scratch memory. */
static bool solve_one(const struct node_problem *problem, double d[NODES], double force[NODES],
                      double stiffness[NODES], unsigned long *iterations)
{
    const struct contact_law *law = problem->laws;
    const double(*m)[NODES] = problem->coupling[0];
    const double *target = problem->target[0];
    double previous = INFINITY;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        /* the excess e, and the matrix 1 + coupling F' */
        quad matrix[NODES];
        double change[NODES];
        for (int i = 0; i < NODES; i++)
            force[i] = contact_law_force(law, d[i], &stiffness[i]);
        const quad forces = {force[0], force[1], force[2], force[3]};
        const quad slopes = {stiffness[0], stiffness[1], stiffness[2], stiffness[3]};
        for (int i = 0; i < NODES; i++) {
            const quad coupling = {m[i][0], m[i][1], m[i][2], m[i][3]};
            quad moved = coupling * forces;
            change[i] = d[i] - target[i] + ((moved[0] + moved[1]) + (moved[2] + moved[3]));
            matrix[i] = coupling * slopes;
            matrix[i][i] += 1.0;
        }
        if (!eliminate(matrix, change))
            return false;
        ++*iterations;
        /* the update, and whether it was the last one */
        struct progress progress = {.previous = previous};
        for (int i = 0; i < NODES; i++) {
            d[i] -= change[i];
            look_at(&progress, change[i], d[i], target[i]);
        }
        if (!isfinite(progress.change))
            return false;
        if (settled(&progress, problem->last_change)) {
            follow(force, stiffness, change);
            return true;
        }
        previous = progress.change;
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
        for (int i = 0; i < NODES; i++) {
            force[c][i] =
                contact_law_force(&problem->laws[c], indentation[c][i], &system->stiffness[c][i]);
            presses = presses || system->stiffness[c][i] != 0.0 || force[c][i] != 0.0;
        }
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
            for (size_t c = 0; c < problem->contacts; c++)
                follow(force[c], stiffness[c], problem->excess + c * NODES);
            return true;
        }
        previous = progress.change;
    }
    return false;
}
