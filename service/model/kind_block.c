/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "model/body.h"
#include "model/describe.h"
#include "model/face.h"
#include "model/key.h"

static const struct key keys[] = {
    {"size", KEY_NUMBERS, &limit_length, true, KEY_OF(body, size),
     KEY_SAYS(NULL, "its edges along x, y and z; it is compact: stiff but for the contact")},
};

static enum percuss_status complete(struct body *body, struct fault *fault)
{
    (void)fault;
    const double *size = body->size;
    double x2 = size[0] * size[0], y2 = size[1] * size[1], z2 = size[2] * size[2];
    body->mass = body->material.density * size[0] * size[1] * size[2];
    body->inertia[0] = body->mass * (y2 + z2) / 12.0;
    body->inertia[1] = body->mass * (z2 + x2) / 12.0;
    body->inertia[2] = body->mass * (x2 + y2) / 12.0;
    return PERCUSS_OK;
}

static double smallest_radius(const struct body *body)
{
    return 0.5 * fmin(body->size[0], fmin(body->size[1], body->size[2]));
}

static int find_faces(const struct body *body, const double p[3], struct face *faces)
{
    const double half[3] = {0.5 * body->size[0], 0.5 * body->size[1], 0.5 * body->size[2]};
    return face_box(half, p, faces);
}

/* Hit on its faces along z. */
static struct solid solid(const struct body *body)
{
    return (struct solid){.form = SOLID_CYLINDER,
                          .axis = 2,
                          .radius = sqrt(body->size[0] * body->size[1] / M_PI),
                          .length = body->size[2],
                          .across = fmin(body->size[0], body->size[1]),
                          .tip_radius = INFINITY,
                          .approximate = true};
}

static void describe(const struct body *body, struct body_description *description)
{
    const double *size = body->size;
    describe_extents(description, 0.5 * size[0], 0.5 * size[1], 0.5 * size[2]);
    describe_add(description, "%g m x %g m x %g m", size[0], size[1], size[2]);
}

const struct body_kind block_kind = {
    .name = "block",
    .keys = keys,
    .key_count = sizeof keys / sizeof *keys,
    .complete = complete,
    .smallest_radius = smallest_radius,
    .faces = find_faces,
    .solid = solid,
    .describe = describe,
};
