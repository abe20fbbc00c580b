/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The tolerance on the restitution decides the number of modes and the time steps; the error is
 * estimated from solutions with fewer modes and longer steps. */
#ifndef PERCUSS_SOLVE_ACCURACY_H
#define PERCUSS_SOLVE_ACCURACY_H

#include "impact/impact.h"
#include "solve/assemble.h"

struct accuracy {
    struct assembly *assembly;     /* of the answer */
    struct impact_outcome outcome; /* the answer */
    double restitution_time, restitution_modes;
    double impulse_time, impulse_modes;
    double amplification;        /* of a relative error of the first sub-impact into e */
    double restitution_by_speed; /* NAN unless asked for */
    double energy_defect;        /* |closure| against what is available or approaches */
    bool energy_closes;          /* as the tolerance demands */
    bool tolerance_met;
};

/* Restitution of a contact, NAN where the compression impulse is 0: Eq. (6). */
double accuracy_restitution(const struct geometry *geometry, const struct impact_outcome *outcome,
                            size_t contact);

/* Solves until the estimated error fits the tolerance or the effort allowed is spent. `memory`
 * holds everything that is returned. PERCUSS_OK or PERCUSS_INTERNAL. */
enum percuss_status accuracy_solve(struct accuracy *accuracy, const struct geometry *geometry,
                                   const struct solve_request *request,
                                   struct prepared_cache *cache, struct arena *memory,
                                   struct fault *fault);

#endif
