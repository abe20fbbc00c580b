/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Twins of measured impacts, asked for on the command line. */
#ifndef PERCUSS_CLI_TWINS_H
#define PERCUSS_CLI_TWINS_H

#include "scene.h"
#include "tally_output.h"
#include "twin.h"

/* Whom to ask for which scene. */
struct twins {
    const struct common *common;
    const struct scene *scene;
    struct scene_bodies bodies;
    struct twin_question question;
    struct tally warnings; /* of the twins asked for last */
    int code;              /* of the answer that was taken last */
};

/* Connects and finds the bodies. Exit code; complains. */
int twins_open(struct twins *twins, const struct common *common, const struct scene *scene);
void twins_close(struct twins *twins);

/* As twin_ask. A refusal of the first is explained. Exit code; complains. */
int twins_ask(struct twins *twins, const struct measured_set *set,
              const struct twin_changes *changes, struct twin *list);

/* The listener that takes the answers of twin_ask; then the exit code of its end. Complain. */
struct twin_listener twins_listener(struct twins *twins);
int twins_code(const struct twins *twins, enum percuss_result result);

/* Completes the measured impacts with the masses that the server knows. Exit code; complains where
 * histories of a body that bends cannot tell the impulse. */
int twins_complete(const struct twins *twins, struct measured_set *set, const struct twin *list);

#endif
