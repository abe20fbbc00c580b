/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/moving.h"

#include <stdlib.h>
#include <string.h>

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
