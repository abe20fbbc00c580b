/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The errors of an answer, by their cause: modes, time steps, models, and the states of bodies that
 * vibrated already. Each module of this folder estimates one of them; total.h adds them up. */
#ifndef PERCUSS_SOLVE_ERROR_BUDGET_H
#define PERCUSS_SOLVE_ERROR_BUDGET_H

#include <stdbool.h>

#include "percuss/vocabulary.h"

struct attempt; /* attempt.h */

/* Scope of the error of the omitted modes. */
enum mode_verdict {
    MODES_ALONE,       /* the modes' error */
    MODES_AND_STEPS,   /* of a sequence, that of longer time steps, too */
    MODES_BELOW_STEPS, /* it is too large, and longer time steps do more */
    MODES_UNCHECKED,   /* not all: the effort did not suffice */
};

/* Of the omitted modes (refinement.h). */
struct mode_error {
    double restitution, impulse;
    enum mode_verdict verdict;
    /* change of a sub-impact's impulse, over itself, or of e where only that is known, over the
     * first-order change of one impact's e; 0: neither is known */
    double strained;
    const struct attempt *longer; /* with longer time steps, in the arena; NULL: none was needed */
};

/* Of the time steps (refinement.h). */
struct step_error {
    double restitution, impulse;
    double energy_defect; /* |closure| over the available energy or the approach's */
    bool energy_closes;   /* as the tolerance demands */
    bool unchecked;       /* of a sequence: the effort did not suffice */
};

/* Of the models (models.h). */
struct model_error {
    double restitution; /* of the contact where it is largest */
    double yield;       /* the part of metals of unstated yield */
    double *impulse;    /* [contact], N s; INFINITY: unknown */
    double friction;    /* by the coefficients' deviations: part of restitution */
    double *tangential; /* [contact], and by them alone, N s along the surface */
};

/* Of the states that the bodies began from (state.h). */
struct state_error {
    double restitution; /* by the errors of modes and steps of the answers before */
    double model;       /* and by their models' */
    /* [body], J, effect of either on its vibration by the forces that it changes; NULL: none */
    double *vibration[2];
};

struct error_budget {
    struct mode_error modes;
    struct step_error steps;
    struct model_error models;
    struct state_error states;
};

#endif
