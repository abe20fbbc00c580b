/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Initial value problems y' = f(t, y) with roots g(t, y) = 0: CVODE behind four verbs. */
#ifndef PERCUSS_NUMERIC_ODE_H
#define PERCUSS_NUMERIC_ODE_H

#include <stdbool.h>
#include <stddef.h>

struct ode;

typedef void ode_rhs(double t, const double *y, double *rate, void *context);
typedef void ode_roots(double t, const double *y, double *roots, void *context);

struct ode_problem {
    size_t size, root_count;
    ode_rhs *rhs;
    ode_roots *roots;
    void *context;
    double relative;        /* tolerance */
    const double *absolute; /* [size] tolerances; copied */
    bool stiff;             /* BDF with Newton's method instead of Adams with fixed-point */
};

/* NULL: out of memory, or CVODE refused. */
struct ode *ode_create(const struct ode_problem *problem);
void ode_free(struct ode *ode);

/* (Re)starts at t with the values y [size]. */
bool ode_set(struct ode *ode, double t, const double *y);

/* Longest step, s; 0: no limit. */
bool ode_set_longest_step(struct ode *ode, double step);

enum ode_event { ODE_REACHED, ODE_ROOT, ODE_STEP, ODE_FAILED };

/* Makes one internal step towards `until` (never beyond). *t and y become the new point; at
 * ODE_ROOT found[i] is +1 or -1 where root i rises or falls through zero. */
enum ode_event ode_step(struct ode *ode, double until, double *t, double *y, int *found);

/* Right-hand sides and steps since creation. */
void ode_effort(const struct ode *ode, unsigned long *rhs, unsigned long *steps);

#endif
