/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/node_solver.h"

#include <math.h>

#include "base/vector_clones.h"
#include "numeric/linear.h"

/* Two nodes of a contact, wherever they lie: what every vector unit has; the lanes' order of
 * operations is that of scalars. */
typedef double pair __attribute__((vector_size(2 * sizeof(double)), aligned(8)));
typedef long long pair_mask __attribute__((vector_size(2 * sizeof(long long))));
#define PAIR(at)       (*(pair *)(at))
#define CONST_PAIR(at) (*(const pair *)(at))

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

/* A row's lanes 0, 1 and 2, 3. */
struct row {
    pair low, high;
};

/* Solves a x = b by elimination in the order given; the matrix is the identity plus a small causal
 * one. False: a pivot is too small for that order. */
static inline bool eliminate(const struct row a[NODES], const double b[NODES], double x[NODES])
{
    /* forward, without exchanges: a pivot that is too small spoils only what is thrown away */
    double p0 = 1.0 / a[0].low[0];
    double f1 = a[1].low[0] * p0;
    double f2 = a[2].low[0] * p0;
    double f3 = a[3].low[0] * p0;
    double a11 = a[1].low[1] - f1 * a[0].low[1];
    double a21 = a[2].low[1] - f2 * a[0].low[1];
    double a31 = a[3].low[1] - f3 * a[0].low[1];
    pair r1 = a[1].high - f1 * a[0].high;
    pair r2 = a[2].high - f2 * a[0].high;
    pair r3 = a[3].high - f3 * a[0].high;
    double b1 = b[1] - f1 * b[0];
    double p1 = 1.0 / a11;
    double g2 = a21 * p1;
    double g3 = a31 * p1;
    r2 -= g2 * r1;
    r3 -= g3 * r1;
    double b2 = b[2] - f2 * b[0] - g2 * b1;
    double p2 = 1.0 / r2[0];
    double l3 = r3[0] * p2;
    double a33 = r3[1] - l3 * r2[1];
    double b3 = b[3] - f3 * b[0] - g3 * b1 - l3 * b2;
    /* and back substitution */
    x[3] = b3 / a33;
    x[2] = (b2 - r2[1] * x[3]) * p2;
    x[1] = (b1 - r1[1] * x[3] - r1[0] * x[2]) * p1;
    x[0] = (b[0] - a[0].high[1] * x[3] - a[0].high[0] * x[2] - a[0].low[1] * x[1]) * p0;
    return a[0].low[0] > LEAST_PIVOT && a11 > LEAST_PIVOT && r2[0] > LEAST_PIVOT &&
           a33 > LEAST_PIVOT;
}

/* What an update changed, against the indentations and against the approaches without force: these
 * can be far larger in a long contact, and set the rounding. */
struct progress {
    double change, previous;
    double indentation, target;
};

/* fmax is a call; this is a comparison of numbers. */
static inline double larger(double a, double b)
{
    return a > b ? a : b;
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
static inline void follow(double force[NODES], const double stiffness[NODES],
                          const double change[NODES])
{
    for (int i = 0; i < NODES; i += 2) {
        pair after = CONST_PAIR(force + i) - CONST_PAIR(stiffness + i) * CONST_PAIR(change + i);
        PAIR(force + i) = (pair)((pair_mask)after & (after > 0.0));
    }
}

static inline double largest_of(const double values[NODES])
{
    double low = fabs(values[0]) > fabs(values[1]) ? fabs(values[0]) : fabs(values[1]);
    double high = fabs(values[2]) > fabs(values[3]) ? fabs(values[2]) : fabs(values[3]);
    return low > high ? low : high;
}

/* Row i of the matrix 1 + coupling F' but for the 1, and what the forces take from the approach. */
static inline double row_of(const double coupling[NODES], const double force[NODES],
                            const double stiffness[NODES], struct row *row)
{
    const pair low = CONST_PAIR(coupling);
    const pair high = CONST_PAIR(coupling + 2);
    pair moved = low * CONST_PAIR(force) + high * CONST_PAIR(force + 2);
    row->low = low * CONST_PAIR(stiffness);
    row->high = high * CONST_PAIR(stiffness + 2);
    return moved[0] + moved[1];
}

/* The excess e, and the matrix. */
static inline void assemble_one(const struct node_problem *problem, const double d[NODES],
                                const double force[NODES], const double stiffness[NODES],
                                struct row a[NODES], double excess[NODES])
{
    const double(*m)[NODES] = problem->coupling[0];
    const double *target = problem->target[0];
    excess[0] = d[0] - target[0] + row_of(m[0], force, stiffness, &a[0]);
    excess[1] = d[1] - target[1] + row_of(m[1], force, stiffness, &a[1]);
    excess[2] = d[2] - target[2] + row_of(m[2], force, stiffness, &a[2]);
    excess[3] = d[3] - target[3] + row_of(m[3], force, stiffness, &a[3]);
    a[0].low += (pair){1.0, 0.0};
    a[1].low += (pair){0.0, 1.0};
    a[2].high += (pair){1.0, 0.0};
    a[3].high += (pair){0.0, 1.0};
}

/* One contact: the usual case, without scratch memory. */
static bool solve_one(const struct node_problem *problem, double d[NODES], double force[NODES],
                      double stiffness[NODES], unsigned long *iterations)
{
    struct progress progress = {.previous = INFINITY, .target = largest_of(problem->target[0])};
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        struct row matrix[NODES];
        double excess[NODES];
        double change[NODES];
        contact_law_forces(problem->laws, d, force, stiffness);
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

static inline double product_of(const double x[NODES], const double y[NODES])
{
    pair sum = CONST_PAIR(x) * CONST_PAIR(y) + CONST_PAIR(x + 2) * CONST_PAIR(y + 2);
    return sum[0] + sum[1];
}

/* A contact's four columns. */
typedef double quad __attribute__((vector_size(NODES * sizeof(double)), aligned(8)));

/* As eliminate, in place, for any number of contacts; those that do not feel each other leave
 * zeros. */
VECTOR_CLONES static bool eliminate_many(size_t n, double *a, double *b)
{
    /* forward, a contact's columns at a time */
    for (size_t c = 0; c < n; c++) {
        const double *row = a + c * n;
        double inverse = 1.0 / row[c];
        size_t right = (c + 1) / NODES * NODES;
        if (!(row[c] > LEAST_PIVOT))
            return false;
        for (size_t i = c + 1; i < n; i++) {
            double *below = a + i * n;
            double factor = below[c] * inverse;
            if (factor == 0.0)
                continue;
            for (size_t k = right; k < n; k += NODES)
                *(quad *)(below + k) -= factor * *(const quad *)(row + k);
            b[i] -= factor * b[c];
        }
    }
    /* and back substitution */
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    return true;
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
    for (size_t a = 0; a < n; a++) {
        double *excess = problem->excess + a * NODES;
        for (int i = 0; i < NODES; i++)
            excess[i] = indentation[a][i] - problem->target[a][i];
        for (size_t q = 0; q < system->pressed_count; q++) {
            const double(*m)[NODES] = problem->coupling[a * n + system->pressed[q]];
            for (int i = 0; i < NODES; i++)
                excess[i] += product_of(m[i], force[system->pressed[q]]);
        }
    }
    /* rows and columns of the pressed ones */
    size_t size = system->pressed_count * NODES;
    for (size_t p = 0; p < system->pressed_count; p++)
        for (size_t q = 0; q < system->pressed_count; q++) {
            size_t b = system->pressed[q];
            const double(*m)[NODES] = problem->coupling[system->pressed[p] * n + b];
            for (size_t i = 0; i < NODES; i++) {
                double *row = problem->matrix + (p * NODES + i) * size + q * NODES;
                for (size_t j = 0; j < NODES; j += 2)
                    PAIR(row + j) = CONST_PAIR(m[i] + j) * CONST_PAIR(system->stiffness[b] + j);
                row[i] += p == q ? 1.0 : 0.0;
            }
        }
}

/* Solves the system of the pressed ones for their changes, in the order given. False: a pivot is
 * too small for that. */
static bool eliminate_pressed(const struct node_problem *problem, struct system *system)
{
    const double *m = problem->matrix;
    if (system->pressed_count != 1)
        return eliminate_many(system->pressed_count * NODES, problem->matrix, system->change);
    struct row rows[NODES];
    double right[NODES];
    for (int i = 0; i < NODES; i++, m += NODES) {
        rows[i] = (struct row){CONST_PAIR(m), CONST_PAIR(m + 2)};
        right[i] = system->change[i];
    }
    return eliminate(rows, right, system->change);
}

/* The right side of the system of the pressed ones. */
static void take_excess(const struct node_problem *problem, struct system *system)
{
    for (size_t p = 0; p < system->pressed_count; p++)
        for (size_t i = 0; i < NODES; i++)
            system->change[p * NODES + i] = problem->excess[system->pressed[p] * NODES + i];
}

/* Turns the excess into the changes of all indentations: of the pressed ones by their system, of
 * an open one a: change_a = e_a - sum over the pressed b of coupling_ab F'_b change_b. */
static bool find_changes(const struct node_problem *problem, struct system *system,
                         double (*indentation)[NODES], double (*force)[NODES])
{
    size_t n = problem->contacts;
    bool open[PERCUSS_MAX_CONTACTS];
    /* the pressed ones by their system, with exchanges of rows where it needs them */
    take_excess(problem, system);
    if (!eliminate_pressed(problem, system)) {
        assemble(problem, system, indentation, force);
        take_excess(problem, system);
        if (!linear_solve(system->pressed_count * NODES, problem->matrix, system->change))
            return false;
    }
    /* the open ones by what those change */
    for (size_t a = 0; a < n; a++)
        open[a] = true;
    for (size_t p = 0; p < system->pressed_count; p++)
        open[system->pressed[p]] = false;
    for (size_t q = 0; q < system->pressed_count; q++) {
        size_t b = system->pressed[q];
        double forces[NODES];
        for (int j = 0; j < NODES; j++)
            forces[j] = system->stiffness[b][j] * system->change[q * NODES + (size_t)j];
        for (size_t a = 0; a < n; a++)
            for (size_t i = 0; open[a] && i < NODES; i++)
                problem->excess[a * NODES + i] -=
                    product_of(problem->coupling[a * n + b][i], forces);
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
    struct progress progress = {.previous = INFINITY};
    for (size_t c = 0; c < problem->contacts; c++)
        progress.target = larger(progress.target, largest_of(problem->target[c]));
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        find_forces(problem, &system, indentation, force);
        assemble(problem, &system, indentation, force);
        if (!find_changes(problem, &system, indentation, force))
            return false;
        ++*iterations;
        /* the update, and whether it was the last one */
        progress.change = progress.indentation = 0.0;
        for (size_t c = 0; c < problem->contacts; c++) {
            const double *change = problem->excess + c * NODES;
            for (int i = 0; i < NODES; i++)
                indentation[c][i] -= change[i];
            if (!isfinite((change[0] + change[1]) + (change[2] + change[3])))
                return false;
            progress.change = larger(progress.change, largest_of(change));
            progress.indentation = larger(progress.indentation, largest_of(indentation[c]));
        }
        if (settled(&progress, problem->last_change)) {
            for (size_t c = 0; c < problem->contacts; c++)
                follow(force[c], stiffness[c], problem->excess + c * NODES);
            return true;
        }
        progress.previous = progress.change;
    }
    return false;
}
