/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "model/body.h"
#include "model/body_kind.h"
#include "model/site.h"

static enum percuss_status half_space_complete(struct body *body, struct fault *fault)
{
    (void)fault;
    body->mass = INFINITY;
    for (int i = 0; i < 3; i++)
        body->inertia[i] = INFINITY;
    return PERCUSS_OK;
}

static double half_space_smallest_radius(const struct body *body)
{
    (void)body;
    return INFINITY;
}

static int half_space_faces(const struct body *body, const double p[3], struct face *faces)
{
    (void)body;
    face_plane(2, 1.0, 0.0, p, &faces[0]);
    return 1;
}

static struct solid half_space_solid(const struct body *body)
{
    (void)body;
    return (struct solid){.form = SOLID_HALF_SPACE, .axis = 2};
}

static void half_space_describe(const struct body *body, struct body_description *description)
{
    (void)body;
    describe_add(description, "fills z <= 0, immovable");
}

const struct body_kind half_space_kind = {
    .name = "half-space",
    .complete = half_space_complete,
    .smallest_radius = half_space_smallest_radius,
    .faces = half_space_faces,
    .solid = half_space_solid,
    .describe = half_space_describe,
};
