/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The tolerance on the restitution decides the number of modes (mode_search.h) and the time steps
 * (step_search.h). */
#ifndef PERCUSS_SOLVE_ACCURACY_H
#define PERCUSS_SOLVE_ACCURACY_H

#include "solve/mode_search.h"
#include "solve/nearby.h"
#include "solve/step_search.h"

struct accuracy {
    struct assembly *assembly;     /* of the answer */
    struct impact_outcome outcome; /* the answer */
    double step_accuracy;          /* that it was solved with, see impact_settings */
    struct mode_error modes;
    struct step_error steps;
    struct nearby nearby;        /* the answer, and those that it was compared with */
    double restitution_by_speed; /* NAN unless asked for */
    bool tolerance_met;
    bool spent; /* the effort allowed ended the search */
};

/* Solves until the estimated error fits the tolerance or the effort allowed is spent, and nothing
 * is left to revise of the problem, whose arena holds everything that is returned. PERCUSS_OK,
 * PERCUSS_INTERNAL or PERCUSS_TIMEOUT; BAD_REQUEST: an overlap that contradicts itself. */
enum percuss_status accuracy_reach(struct accuracy *accuracy, struct problem *problem,
                                   struct pace *pace, struct fault *fault);

#endif
