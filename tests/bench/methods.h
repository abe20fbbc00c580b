/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One solve of the fixed problem by each method: the total impulse. */
#ifndef PERCUSS_BENCH_METHODS_H
#define PERCUSS_BENCH_METHODS_H

#include "impact/flight.h"
#include "integrator.h"
#include "scenes.h"

/* Everything is allocated when a method is opened; a run allocates nothing but scratch memory. */
struct method {
    const struct scene *scene;
    double horizon;
    double restitution; /* of the last run */
    struct arena arena; /* of what stays */

    /* modal */
    double accuracy;
    struct arena scratch;

    /* all others */
    struct contact_ode ode;
    struct motion motion;
    struct flight flight;
    struct integrator *integrator;                              /* NULL: Verlet */
    double *cosine, *sine_by_omega, *omega_sine, *kick, *state; /* Verlet, per step */
    double step;
};

/* Opens for impact_modal at a relative accuracy of the impulse. */
bool method_open_modal(struct method *method, const struct fixed_scene *fixed, double accuracy);
bool method_run_modal(struct method *method);

/* Opens for an integrator of SUNDIALS. */
typedef struct integrator *integrator_maker(struct contact_ode *ode,
                                            const struct integrator_settings *settings);
bool method_open_integrator(struct method *method, const struct fixed_scene *fixed,
                            integrator_maker *make, const struct integrator_settings *settings);
/* Integrates the contacts, with exact flights by the library between them. */
bool method_run_phases(struct method *method);
/* Integrates contacts and flights alike until vibration can cause no further contact. */
bool method_run_whole(struct method *method);

/* Opens for Strang splitting with this many steps in a contact: exact rotation of the modes, kicks
 * by the contact force. */
bool method_open_verlet(struct method *method, const struct fixed_scene *fixed, double steps);
bool method_run_verlet(struct method *method);

void method_close(struct method *method);

#endif
