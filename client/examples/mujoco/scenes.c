/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "scenes.h"

#include <string.h>

const struct scene scenes[] = {
    /* acos(1 - h / 0.5) with h = 0.2^2 / (2 * 9.81): the sphere arrives with 0.2 m/s */
    {.name = "pendulum-hinged-bar",
     .body_count = 2,
     .bodies = {{"sph", "sphere", false}, {"bar", "bar", true}},
     .angle = 0.09033544096549502,
     .duration = 2.0},
    {.name = "pendulum-bar-pinned-at-end",
     .body_count = 2,
     .bodies = {{"sph", "sphere", false}, {"bar", "bar-pinned", true}},
     .angle = 0.02,
     .speed = -0.4,
     .duration = 0.3},
    {.name = "pendulum-free-bar",
     .body_count = 2,
     .bodies = {{"sph", "sphere", false}, {"bar", "bar", true}},
     .angle = 0.02,
     .speed = -0.4,
     .duration = 0.3},
    {.name = "two-spheres-free-bar",
     .body_count = 3,
     .bodies = {{"s1", "sphere", false}, {"s2", "sphere", false}, {"bar", "bar", true}},
     .speed = 0.2,
     .duration = 0.3},
    {.name = "spinning-sphere-free-bar",
     .body_count = 2,
     .bodies = {{"sph", "sphere", false}, {"bar", "bar", true}},
     .speed = 0.2,
     .duration = 0.05,
     .slide = 0.1,
     .spin = 20.0,
     .friction = 0.3},
    /* the ball on a double pendulum meets the wall at 50 degrees from its normal */
    {.name = "double-pendulum-wall",
     .body_count = 2,
     .bodies = {{"sph", "sphere", false}, {"world", "wall", false}},
     .speed = 2.0,
     .duration = 0.02,
     .friction = 0.1},
};
const size_t scene_count = sizeof scenes / sizeof *scenes;

void scene_start(const struct scene *scene, struct engine *engine)
{
    const mjModel *model = engine->model;
    mj_resetData(model, engine->data);
    for (size_t i = 0; i < scene->body_count; i++) {
        if (strcmp(scene->bodies[i].id, "sphere") != 0)
            continue;
        int joint = model->body_jntadr[engine->bodies[i]];
        if (model->jnt_type[joint] == mjJNT_HINGE)
            engine->data->qpos[model->jnt_qposadr[joint]] = scene->angle;
        double *speeds = engine->data->qvel + model->jnt_dofadr[joint];
        speeds[0] = scene->speed;
        if (model->jnt_type[joint] == mjJNT_FREE) {
            speeds[1] = scene->slide;
            speeds[5] = scene->spin;
        }
    }
    engine->friction = scene->friction;
    mj_forward(model, engine->data);
}
