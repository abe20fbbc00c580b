/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The scenes: which model, which bodies, how it starts. */
#ifndef MUJOCO_SCENES_H
#define MUJOCO_SCENES_H

#include "engine.h"

struct scene {
    const char *name; /* and of the model's file */
    size_t body_count;
    struct engine_body bodies[ENGINE_BODIES];
    double angle;    /* of a pendulum sphere's joint at the start, rad */
    double speed;    /* at which spheres start: of the joint, rad/s, or along x, m/s */
    double duration; /* s */
    double slide;    /* of spheres at the start: along y, m/s, */
    double spin;     /* and about z, rad/s */
    double friction; /* coefficient of the contacts; 0: the catalogue's, which has none */
};

extern const struct scene scenes[];
extern const size_t scene_count;

/* Sets the model to the scene's start. */
void scene_start(const struct scene *scene, struct engine *engine);

#endif
