/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Other simulators: how each takes a contact, and its parameters as it reads them. */
#ifndef PERCUSS_CLI_ENGINE_TEXT_H
#define PERCUSS_CLI_ENGINE_TEXT_H

#include <stdio.h>

#include "engine_model.h"

/* What the parameters are for. */
struct engine_case {
    const char *title;   /* the bodies, one line */
    const char *version; /* of percuss */
    double step;         /* of the simulator's time as it was given, s; 0: any */
    struct engine_point *points;
    size_t count;
};

struct engine {
    const char *name;
    enum engine_law law;
    const char *comment, *comment_end; /* of its language */
    const char *model;                 /* what it computes, in words */
    void (*print)(FILE *file, const struct engine_case *engine_case, const struct engine_fit *fit);
};

/* The one of that name; NULL: there is none. */
const struct engine *engine_find(const char *name);

/* All of them in words, and one by one. */
#define ENGINE_NAMES "mujoco, bullet, chrono, drake, dem or abaqus"
enum { ENGINE_COUNT = 6 };
const char *engine_name(unsigned i);

/* The parameters as the simulator reads them; above them in comments what they are for, and how far
 * the simulator's restitution is from percuss's. */
void engine_print(FILE *file, const struct engine *engine, const struct engine_case *engine_case,
                  const struct engine_fit *fit);

#endif
