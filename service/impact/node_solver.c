/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/node_solver.h"

#include <math.h>

#include "numeric/linear.h"

enum { MAX_ITERATIONS = 40 };
/* One row of a 4 x 4 system; the lanes' order of operations is that of scalars. */
typedef double quad __attribute__((vector_size(NODES * sizeof(double))));

/* Solves a x = b by elimination in the order given; the matrix is the identity plus a small causal
 * one. False: a pivot is too small for that order. */
static bool eliminate(quad a[NODES], double b[NODES])
{
    double inverse[NODES];
    for (int c = 0; c < NODES; c++) {
        if (!(fabs(a[c][c]) > 0.1))
            return false;
        inverse[c] = 1.0 / a[c][c];
        for (int i = c + 1; i < NODES; i++) {
            double factor = a[i][c] * inverse[c];
            a[i] -= factor * a[c];
            b[i] -= factor * b[c];
        }
    }
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

static bool settled(const struct progress *progress, double last_change)
{
    return progress->change <= last_change * progress->indentation ||
           progress->change <= 1e-15 * progress->target ||
           (progress->change <= 1e-12 * progress->target && progress->change >= progress->previous);
}

/* Forces after the last, tiny update: the slope that it was made with carries them along. */
static void follow(double force[NODES], const double stiffness[NODES], const double change[NODES])
{
    for (int i = 0; i < NODES; i++)
        force[i] = fmax(0.0, force[i] - stiffness[i] * change[i]);
}

/* One active contact: the usual case, without scratch memory. */
static bool solve_one(const struct node_problem *problem, double d[NODES], double force[NODES],
                      double stiffness[NODES], unsigned long *iterations)
{
    size_t contact = problem->list[0];
    const struct contact_law *law = &problem->laws[contact];
    const double(*m)[NODES] = problem->coupling[contact * problem->contacts + contact];
    const double *target = problem->target[0];
    double previous = INFINITY;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        quad jacobian[NODES];
        double residual[NODES];
        for (int i = 0; i < NODES; i++)
            force[i] = contact_law_force(law, d[i], &stiffness[i]);
        const quad forces = {force[0], force[1], force[2], force[3]};
        const quad slopes = {stiffness[0], stiffness[1], stiffness[2], stiffness[3]};
        for (int i = 0; i < NODES; i++) {
            const quad coupling = {m[i][0], m[i][1], m[i][2], m[i][3]};
            quad moved = coupling * forces;
            residual[i] = d[i] - target[i] + ((moved[0] + moved[1]) + (moved[2] + moved[3]));
            jacobian[i] = coupling * slopes;
            jacobian[i][i] += 1.0;
        }
        if (!eliminate(jacobian, residual))
            return false;
        ++*iterations;
        struct progress progress = {.previous = previous};
        for (int i = 0; i < NODES; i++) {
            d[i] -= residual[i];
            look_at(&progress, residual[i], d[i], target[i]);
        }
        if (!isfinite(progress.change))
            return false;
        if (settled(&progress, problem->last_change)) {
            follow(force, stiffness, residual);
            return true;
        }
        previous = progress.change;
    }
    return false;
}

/* Newton's system of several contacts. An open contact bears no force and its indentation follows
 * from those of the pressed ones, so that only these are solved for. */
struct system {
    double (*stiffness)[NODES];                  /* [all contacts] */
    double change[PERCUSS_MAX_CONTACTS * NODES]; /* of the pressed ones */
    size_t pressed[PERCUSS_MAX_CONTACTS];        /* places in the problem's list */
    size_t pressed_count;
};

static void find_forces(const struct node_problem *problem, struct system *system,
                        double (*indentation)[NODES], double (*force)[NODES])
{
    system->pressed_count = 0;
    for (size_t a = 0; a < problem->count; a++) {
        size_t c = problem->list[a];
        bool presses = false;
        for (int i = 0; i < NODES; i++) {
            force[c][i] =
                contact_law_force(&problem->laws[c], indentation[c][i], &system->stiffness[c][i]);
            presses = presses || system->stiffness[c][i] != 0.0 || force[c][i] != 0.0;
        }
        if (presses)
            system->pressed[system->pressed_count++] = a;
    }
}

static const double (*coupling_of(const struct node_problem *problem, size_t a, size_t b))[NODES]
{
    return problem->coupling[problem->list[a] * problem->contacts + problem->list[b]];
}

/* Residuals of all contacts, and the matrix of the pressed ones. */
static void assemble(const struct node_problem *problem, const struct system *system,
                     double (*indentation)[NODES], double (*force)[NODES])
{
    for (size_t a = 0; a < problem->count; a++)
        for (int i = 0; i < NODES; i++) {
            double sum = indentation[problem->list[a]][i] - problem->target[a][i];
            for (size_t q = 0; q < system->pressed_count; q++) {
                const double(*m)[NODES] = coupling_of(problem, a, system->pressed[q]);
                const double *f = force[problem->list[system->pressed[q]]];
                for (int j = 0; j < NODES; j++)
                    sum += m[i][j] * f[j];
            }
            problem->residual[a * NODES + (size_t)i] = sum;
        }
    size_t size = system->pressed_count * NODES;
    for (size_t p = 0; p < system->pressed_count; p++)
        for (size_t q = 0; q < system->pressed_count; q++) {
            const double(*m)[NODES] = coupling_of(problem, system->pressed[p], system->pressed[q]);
            const double *stiffness = system->stiffness[problem->list[system->pressed[q]]];
            for (size_t i = 0; i < NODES; i++) {
                double *row = problem->matrix + (p * NODES + i) * size + q * NODES;
                for (size_t j = 0; j < NODES; j++)
                    row[j] = m[i][j] * stiffness[j] + (p == q && i == j);
            }
        }
}

/* Turns the residuals into the changes of all indentations. */
static bool find_changes(const struct node_problem *problem, struct system *system)
{
    size_t size = system->pressed_count * NODES;
    bool open[PERCUSS_MAX_CONTACTS];
    for (size_t a = 0; a < problem->count; a++)
        open[a] = true;
    for (size_t p = 0; p < system->pressed_count; p++) {
        open[system->pressed[p]] = false;
        for (size_t i = 0; i < NODES; i++)
            system->change[p * NODES + i] = problem->residual[system->pressed[p] * NODES + i];
    }
    if (!linear_solve(size, problem->matrix, system->change))
        return false;
    for (size_t a = 0; a < problem->count; a++) {
        for (size_t q = 0; open[a] && q < system->pressed_count; q++) {
            const double(*m)[NODES] = coupling_of(problem, a, system->pressed[q]);
            const double *stiffness = system->stiffness[problem->list[system->pressed[q]]];
            for (size_t i = 0; i < NODES; i++)
                for (size_t j = 0; j < NODES; j++)
                    problem->residual[a * NODES + i] -=
                        m[i][j] * stiffness[j] * system->change[q * NODES + j];
        }
    }
    for (size_t p = 0; p < system->pressed_count; p++)
        for (size_t i = 0; i < NODES; i++)
            problem->residual[system->pressed[p] * NODES + i] = system->change[p * NODES + i];
    return true;
}

bool node_solve(const struct node_problem *problem, double (*indentation)[NODES],
                double (*force)[NODES], double (*stiffness)[NODES], unsigned long *iterations)
{
    size_t first = problem->list[0];
    if (problem->count == 1 &&
        solve_one(problem, indentation[first], force[first], stiffness[first], iterations))
        return true;
    struct system system;
    system.stiffness = stiffness; /* the rest is scratch */
    double previous = INFINITY;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        find_forces(problem, &system, indentation, force);
        assemble(problem, &system, indentation, force);
        if (!find_changes(problem, &system))
            return false;
        ++*iterations;
        struct progress progress = {.previous = previous};
        for (size_t row = 0; row < problem->count * NODES; row++) {
            double *d = &indentation[problem->list[row / NODES]][row % NODES];
            *d -= problem->residual[row];
            look_at(&progress, problem->residual[row], *d,
                    problem->target[row / NODES][row % NODES]);
        }
        if (!isfinite(progress.change))
            return false;
        if (settled(&progress, problem->last_change)) {
            for (size_t a = 0; a < problem->count; a++)
                follow(force[problem->list[a]], stiffness[problem->list[a]],
                       problem->residual + a * NODES);
            return true;
        }
        previous = progress.change;
    }
    return false;
}
