/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Simulated twins of measured impacts. */
#ifndef PERCUSS_CLI_TWINS_H
#define PERCUSS_CLI_TWINS_H

#include "impact.h"
#include "scene.h"
#include "tally.h"

/* What the server says of an impact, in the terms of struct measured_impact. */
struct twin {
    enum percuss_status status;
    struct measured_impact impact;
    double inverse_mass; /* effective, 1/kg */
    bool a_is_rigid;
};

/* A parameter of one of the two bodies that differs from the catalogue's. */
struct twin_override {
    unsigned body; /* 0: A, 1: B */
    struct percuss_override override;
};

/* Whom to ask for which scene. */
struct twins {
    struct percuss_client *client;
    const struct common *common;
    const struct scene *scene;
    struct scene_bodies bodies;
    struct tally warnings; /* of the twins asked for last */
};

/* Connects and finds the bodies. Exit code; complains. */
int twins_open(struct twins *twins, const struct common *common, const struct scene *scene);
void twins_close(struct twins *twins);

/* Asks for the twin of every impact, in batches, with these overrides and all speeds times
 * `faster`. A refusal of the first is
 * explained. Exit code; complains. */
int twins_ask(struct twins *twins, const struct measured_set *set,
              const struct twin_override *overrides, size_t override_count, double faster,
              struct twin *twin_list);

/* Completes what was measured with the masses that the server knows. Exit code; complains where
 * histories of a body that bends cannot tell the impulse. */
int twins_complete(const struct twins *twins, struct measured_set *set,
                   const struct twin *twin_list);

#endif
