/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What is asked of the solver: bodies by their ids, where they are and how they move, and where
 * they touch. Units SI; conventions as in docs/architecture.md. */
#ifndef PERCUSS_SOLVE_REQUEST_H
#define PERCUSS_SOLVE_REQUEST_H

#include <stdbool.h>
#include <stddef.h>

#include "contact/body_state.h"
#include "model/body.h"

struct solve_body {
    char id[PERCUSS_ID_SIZE];
    double position[3];
    double orientation[4]; /* (w, x, y, z) */
    double velocity[3];
    double angular_velocity[3];
    const struct body_state *state; /* NULL: at rest, without dents; borrowed */
    double elapsed;                 /* s since that state */
    size_t variation_count;
    struct body_variation variations[PERCUSS_PARAMETER_COUNT]; /* instead of the catalogue's */
};

struct solve_contact {
    unsigned a, b; /* indices into bodies */
    double point[3];
    double normal[3];
    double gap;
    double gap_acceleration;
};

struct solve_options {
    double tolerance; /* on e; 0: 1e-3 */
    double horizon;   /* s; 0: max(20 ms, two longest periods) */
    enum percuss_contact_model contact_model;
    enum percuss_method method;
    enum percuss_compliance compliance;
    enum percuss_dents dents;
    bool conditioning;
    bool trace; /* also the time histories */
};

struct solve_request {
    size_t body_count, contact_count;
    struct solve_body bodies[PERCUSS_MAX_BODIES];
    struct solve_contact contacts[PERCUSS_MAX_CONTACTS];
    const double *delassus; /* contact_count^2, row-major; NULL: the service's; borrowed */
    struct solve_options options;
};

#endif
