/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The model of one FMU: its variables and its behaviour. The functions of the standard (fmu.c and
 * those beside it) are the same for all. */
#ifndef PERCUSS_FMI_MODEL_H
#define PERCUSS_FMI_MODEL_H

#include "fmi3_types.h"
#include "variable.h"

struct fmu;

/* Where a communication step ended. */
struct model_step {
    double time;
    bool event; /* is to be handled in event mode */
};

/* Numbers are a struct of the model's that begins with a struct shared (shared.h) and holds no
 * pointer: a copy of its bytes is a state of the FMU. Functions report faults by fmu_error. */
struct model {
    const char *identifier; /* of the file */
    const char *meaning;
    const char *token; /* tells its states and descriptions from those of others */
    const struct variable *variables;
    size_t variable_count;
    size_t size; /* of the numbers */

    /* checks the parameters and fills the numbers that are not the importer's */
    fmi3Status (*initialize)(struct fmu *fmu);
    /* computes derivatives, indicators and continuous outputs */
    void (*refresh)(void *numbers);
    /* changes discrete variables, and tells whether continuous states changed with them */
    fmi3Status (*update)(struct fmu *fmu, bool *states_changed);
    /* after a step of the importer's integrator; whether an event was missed in it */
    bool (*completed)(void *numbers);
    /* goes on to that time of Co-Simulation, and handles events on the way; but where the importer
     * uses event mode it stops early at one, if allowed, and leaves those at the end to `update` */
    fmi3Status (*step)(struct fmu *fmu, double end, struct model_step *outcome);
};

/* The one of this FMU. */
extern const struct model MODEL;

#endif
