/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Measured restitutions, laid over the picture of a sweep. */
#ifndef PERCUSS_CLI_SWEEP_MEASURED_H
#define PERCUSS_CLI_SWEEP_MEASURED_H

#include <argp.h>

#include "impact.h"
#include "scene.h"

enum { SWEEP_MEASURED_MOST = 8 };

struct sweep_measured {
    const char *file;
    char *b; /* on this body; NULL: on any */
    struct measured_set set;
};

struct sweep_measurements {
    size_t count;
    struct sweep_measured list[SWEEP_MEASURED_MOST];
    struct column_map columns; /* of all files */
};

/* Takes "FILE" or "ID=FILE". What is wrong ends the process through argp_error, here and below. */
void sweep_measured_add(struct sweep_measurements *measurements, const char *text,
                        struct argp_state *state);

/* Once the whole command line is known: reads the files, of bodies that are asked for, which a
 * picture is made to hold. */
void sweep_measured_read(struct sweep_measurements *measurements, const struct scene *scene,
                         bool is_drawn, struct argp_state *state);

void sweep_measured_free(struct sweep_measurements *measurements);

#endif
