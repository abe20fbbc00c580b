/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A general integrator of SUNDIALS on the problem of one contact, with the approach as root. */
#ifndef PERCUSS_BENCH_INTEGRATOR_H
#define PERCUSS_BENCH_INTEGRATOR_H

#include "contact_ode.h"

enum integrator_event { INTEGRATOR_REACHED, INTEGRATOR_ROOT, INTEGRATOR_FAILED };

struct integrator_settings {
    double tolerance; /* relative, and absolute in the problem's units */
    bool energetic;   /* weights, see contact_ode_weights */
    int order;        /* of the explicit method; 0: the default */
};

struct integrator;

struct integrator_operations {
    bool (*restart)(struct integrator *integrator, double t);
    enum integrator_event (*advance)(struct integrator *integrator, double until, double *t);
    void (*free)(struct integrator *integrator);
};

struct integrator {
    const struct integrator_operations *operations;
    struct contact_ode *ode;
    double *y; /* [2 stride]: write it before a restart, read it after an advance */
};

/* NULL: out of memory, or SUNDIALS refused. */
struct integrator *integrator_adams(struct contact_ode *ode,
                                    const struct integrator_settings *settings);
struct integrator *integrator_bdf(struct contact_ode *ode,
                                  const struct integrator_settings *settings);
struct integrator *integrator_explicit(struct contact_ode *ode,
                                       const struct integrator_settings *settings);

#endif
