/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/moving.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <zmumps_c.h>

/* The stages Y = u0 1 + h A (dY/dt), A = T diag(pole, its conjugate) T^-1, become p = the first of
 * T^-1 Y, with T scaled so that the first of T^-1 1 is 1; u1 = u0 (1 - d 1) + d Y with d = b A^-1.
 */
struct rational rational_make(enum rational_rule rule)
{
    /* the method's places, matrix and weights */
    double w = sqrt(3.0) / 6.0;
    bool radau = rule == RATIONAL_RADAU;
    double place[2] = {radau ? 1.0 / 3.0 : 0.5 - w, radau ? 1.0 : 0.5 + w};
    double a[2][2] = {{radau ? 5.0 / 12.0 : 0.25, radau ? -1.0 / 12.0 : 0.25 - w},
                      {radau ? 0.75 : 0.25 + w, 0.25}};
    double b[2] = {radau ? 0.75 : 0.5, radau ? 0.25 : 0.5};
    /* the eigenvalue and its vector t; the other column of T is conjugate */
    double half_trace = 0.5 * (a[0][0] + a[1][1]);
    double determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    double complex pole = half_trace + I * sqrt(determinant - half_trace * half_trace);
    double complex t[2] = {a[0][1], pole - a[0][0]};
    double complex over = t[0] * conj(t[1]) - conj(t[0]) * t[1];
    double complex inverse[2] = {conj(t[1]) / over, -conj(t[0]) / over};
    double complex scale = inverse[0] + inverse[1];
    /* d = b A^-1 */
    double d[2] = {(b[0] * a[1][1] - b[1] * a[1][0]) / determinant,
                   (b[1] * a[0][0] - b[0] * a[0][1]) / determinant};
    struct rational made = {.pole = pole, .keep = 1.0 - d[0] - d[1]};
    made.weight = scale * (d[0] * t[0] + d[1] * t[1]);
    for (int i = 0; i < 2; i++) {
        made.start += inverse[i] / scale * (1.0 - place[i]);
        made.end += inverse[i] / scale * place[i];
    }
    return made;
}

/* MUMPS's own number for the communicator of all processes where there is no MPI */
static const MUMPS_INT COMM_WORLD = -987654;
enum { JOB_INIT = -1, JOB_END = -2, JOB_ANALYSE_FACTOR = 4, JOB_SOLVE = 3 };
enum { SYMMETRIC = 2, HOST_WORKS = 1, SCOTCH = 3 };
/* Right-hand sides solved at a time: more take memory and save nothing. */
static const MUMPS_INT SIDES_AT_A_TIME = 32;

struct kept_factor {
    ZMUMPS_STRUC_C mumps;
    MUMPS_INT *rows, *columns;
    mumps_double_complex *values;
    size_t freedoms;
};

/* entries of the upper triangle; a held freedom has its own equation 1 x = right */
static size_t factor_fill(const struct system3 *system, double complex s,
                          struct kept_factor *factor)
{
    size_t used = 0;
    for (size_t i = 0; i < system->nodes; i++)
        for (size_t b = system->first[i]; b < system->first[i + 1]; b++)
            for (size_t c = 0; c < 9; c++) {
                size_t row = 3 * i + c / 3, column = 3 * system->columns[b] + c % 3;
                bool held = system->held[row] || system->held[column];
                if (row > column || (held && row != column))
                    continue;
                double complex value = system->stiffness[b][c];
                if (c / 3 == c % 3)
                    value += s * system->mass[b];
                if (held)
                    value = 1.0;
                factor->rows[used] = (MUMPS_INT)row + 1;
                factor->columns[used] = (MUMPS_INT)column + 1;
                factor->values[used++] = (mumps_double_complex){creal(value), cimag(value)};
            }
    return used;
}

static bool factor_prepare(const struct system3 *system, double complex s,
                           struct kept_factor *factor)
{
    size_t room = 9 * system->first[system->nodes];
    factor->freedoms = system->freedoms;
    factor->rows = malloc(room * sizeof *factor->rows);
    factor->columns = malloc(room * sizeof *factor->columns);
    factor->values = malloc(room * sizeof *factor->values);
    if (!factor->rows || !factor->columns || !factor->values)
        return false;
    ZMUMPS_STRUC_C *mumps = &factor->mumps;
    mumps->n = (MUMPS_INT)system->freedoms;
    mumps->nnz = (MUMPS_INT8)factor_fill(system, s, factor);
    mumps->irn = factor->rows;
    mumps->jcn = factor->columns;
    mumps->a = factor->values;
    return true;
}

enum percuss_status kept_factor_create(const struct system3 *system, double complex s,
                                       struct kept_factor **made, struct fault *fault)
{
    *made = NULL;
    struct kept_factor *factor = calloc(1, sizeof *factor);
    if (!factor)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    ZMUMPS_STRUC_C *mumps = &factor->mumps;
    mumps->job = JOB_INIT;
    mumps->par = HOST_WORKS;
    mumps->sym = SYMMETRIC;
    mumps->comm_fortran = COMM_WORLD;
    zmumps_c(mumps);
    /* silent; fill-reducing order by Scotch; numbers of control as its manual counts them, from 1
     */
    mumps->icntl[0] = mumps->icntl[1] = mumps->icntl[2] = -1;
    mumps->icntl[3] = 0;
    mumps->icntl[6] = SCOTCH;
    mumps->icntl[26] = SIDES_AT_A_TIME;
    bool prepared = factor_prepare(system, s, factor);
    if (prepared) {
        mumps->job = JOB_ANALYSE_FACTOR;
        zmumps_c(mumps);
    }
    if (!prepared || mumps->infog[0] < 0) {
        int code = prepared ? (int)mumps->infog[0] : 0;
        kept_factor_free(factor);
        return fault_set(fault, PERCUSS_INTERNAL, "MUMPS: error %d for %zu freedoms", code,
                         system->freedoms);
    }
    /* the factor is in MUMPS's own memory now */
    free(factor->rows);
    free(factor->columns);
    free(factor->values);
    factor->rows = factor->columns = NULL;
    factor->values = NULL;
    *made = factor;
    return PERCUSS_OK;
}

void kept_factor_free(struct kept_factor *factor)
{
    if (!factor)
        return;
    factor->mumps.job = JOB_END;
    zmumps_c(&factor->mumps);
    free(factor->rows);
    free(factor->columns);
    free(factor->values);
    free(factor);
}

bool kept_factor_solve(struct kept_factor *factor, size_t count, double complex *right)
{
    ZMUMPS_STRUC_C *mumps = &factor->mumps;
    /* C's complex numbers lie in memory as MUMPS's do: real, imaginary */
    mumps->rhs = (mumps_double_complex *)right;
    mumps->nrhs = (MUMPS_INT)count;
    mumps->lrhs = (MUMPS_INT)factor->freedoms;
    mumps->job = JOB_SOLVE;
    zmumps_c(mumps);
    return mumps->infog[0] >= 0;
}

double kept_factor_size(const struct kept_factor *factor)
{
    /* INFOG(29); in millions where negative */
    double size = factor->mumps.infog[28];
    return size < 0.0 ? -1e6 * size : size;
}

/* Unit forces solved at once for the compliance: bounds its memory. */
enum { FORCES_AT_ONCE = 32 };

enum percuss_status moving_create(const struct system3 *system, const struct pressed *pressed,
                                  double rise, struct moving *moving, struct fault *fault)
{
    size_t n = system->freedoms;
    *moving = (struct moving){.system = system, .pressed = pressed};
    moving->u = calloc(n, sizeof(double));
    moving->v = calloc(n, sizeof(double));
    moving->next_u = calloc(n, sizeof(double));
    moving->next_v = calloc(n, sizeof(double));
    moving->scratch = calloc(2 * n, sizeof(double));
    if (!moving->u || !moving->v || !moving->next_u || !moving->next_v || !moving->scratch) {
        moving_free(moving);
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory for a body of %zu freedoms", n);
    }
    for (size_t i = 0; i < system->nodes; i++)
        moving->v[3 * i + 2] = rise;
    return PERCUSS_OK;
}

void moving_free(struct moving *moving)
{
    free(moving->u);
    free(moving->v);
    free(moving->next_u);
    free(moving->next_v);
    free(moving->scratch);
    memset(moving, 0, sizeof *moving);
}

enum percuss_status pace3_create(const struct system3 *system, enum rational_rule rule, double step,
                                 struct pace3 *pace, struct fault *fault)
{
    *pace = (struct pace3){.rule = rational_make(rule), .step = step};
    double complex length = pace->rule.pole * step;
    return kept_factor_create(system, 1.0 / (length * length), &pace->factor, fault);
}

void pace3_free(struct pace3 *pace)
{
    kept_factor_free(pace->factor);
    pace->factor = NULL;
}

static void add_forces(const struct pressed *pressed, const double *force, double complex share,
                       double complex *right)
{
    for (size_t i = 0; force && i < pressed->count; i++)
        for (size_t c = 0; c < 3; c++)
            right[3 * pressed->nodes[i] + c] += share * force[i] * pressed->directions[i][c];
}

static void drop_held(const struct system3 *system, double complex *right)
{
    for (size_t f = 0; f < system->freedoms; f++)
        if (system->held[f])
            right[f] = 0.0;
}

void moving_load(struct moving *moving, const struct pace3 *pace, const double *start,
                 double complex *right)
{
    size_t n = moving->system->freedoms;
    double complex length = pace->rule.pole * pace->step, s = 1.0 / (length * length);
    /* s M (u0 + pole h v0) and the forces */
    double *mu = moving->scratch, *mv = mu + n;
    system3_mass(moving->system, moving->u, mu);
    system3_mass(moving->system, moving->v, mv);
    for (size_t f = 0; f < n; f++)
        right[f] = s * mu[f] + s * length * mv[f];
    add_forces(moving->pressed, start, pace->rule.start, right);
    drop_held(moving->system, right);
}

void moving_try(struct moving *moving, const struct pace3 *pace, const double complex *solution)
{
    const struct rational *rule = &pace->rule;
    double complex length = rule->pole * pace->step;
    for (size_t f = 0; f < moving->system->freedoms; f++) {
        double complex p = solution[f], q = (p - moving->u[f]) / length;
        moving->next_u[f] = rule->keep * moving->u[f] + 2.0 * creal(rule->weight * p);
        moving->next_v[f] = rule->keep * moving->v[f] + 2.0 * creal(rule->weight * q);
    }
}

void moving_load_end(const struct moving *moving, const struct pace3 *pace, const double *end,
                     double complex *right)
{
    memset(right, 0, moving->system->freedoms * sizeof *right);
    add_forces(moving->pressed, end, pace->rule.end, right);
    drop_held(moving->system, right);
}

void moving_press(struct moving *moving, const struct pace3 *pace, const double complex *solution)
{
    double complex length = pace->rule.pole * pace->step;
    for (size_t f = 0; f < moving->system->freedoms; f++) {
        double complex p = pace->rule.weight * solution[f];
        moving->next_u[f] += 2.0 * creal(p);
        moving->next_v[f] += 2.0 * creal(p / length);
    }
}

void moving_accept(struct moving *moving)
{
    double *u = moving->u, *v = moving->v;
    moving->u = moving->next_u;
    moving->v = moving->next_v;
    moving->next_u = u;
    moving->next_v = v;
}

double moving_at(const struct moving *moving, size_t i, bool tried)
{
    const double *u = (tried ? moving->next_u : moving->u) + 3 * moving->pressed->nodes[i];
    const double *direction = moving->pressed->directions[i];
    return u[0] * direction[0] + u[1] * direction[1] + u[2] * direction[2];
}

/* the answers to unit forces on `many` nodes from `from` on */
static void take_columns(const struct pressed *pressed, size_t freedoms, double complex weight,
                         const size_t range[2], const double complex *answers, double *compliance)
{
    for (size_t k = 0; k < range[1]; k++)
        for (size_t i = 0; i < pressed->count; i++) {
            double complex along = 0.0;
            for (size_t c = 0; c < 3; c++)
                along +=
                    answers[k * freedoms + 3 * pressed->nodes[i] + c] * pressed->directions[i][c];
            compliance[i * pressed->count + range[0] + k] += 2.0 * creal(weight * along);
        }
}

bool pressed_add_compliance(const struct system3 *system, const struct pressed *pressed,
                            const struct pace3 *pace, double *compliance)
{
    size_t n = system->freedoms, count = pressed->count;
    double complex *right = malloc(FORCES_AT_ONCE * n * sizeof *right);
    bool solved = right != NULL;
    for (size_t from = 0; solved && from < count; from += FORCES_AT_ONCE) {
        size_t many = count - from < FORCES_AT_ONCE ? count - from : FORCES_AT_ONCE;
        memset(right, 0, many * n * sizeof *right);
        for (size_t k = 0; k < many; k++)
            for (size_t c = 0; c < 3; c++) {
                size_t f = 3 * pressed->nodes[from + k] + c;
                if (!system->held[f])
                    right[k * n + f] = pace->rule.end * pressed->directions[from + k][c];
            }
        solved = kept_factor_solve(pace->factor, many, right);
        if (solved)
            take_columns(pressed, n, pace->rule.weight, (const size_t[2]){from, many}, right,
                         compliance);
    }
    free(right);
    return solved;
}

double moving_vibration(struct moving *moving)
{
    const struct system3 *system = moving->system;
    double *product = moving->scratch, energy = 0.0;
    system3_stiffness(system, moving->u, product);
    for (size_t f = 0; f < system->freedoms; f++)
        energy += 0.5 * moving->u[f] * product[f];
    system3_mass(system, moving->v, product);
    for (size_t f = 0; f < system->freedoms; f++)
        energy += 0.5 * moving->v[f] * product[f];
    double mean = system3_mean(system, moving->v, 2);
    return energy - 0.5 * system->whole * mean * mean;
}
