/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "model/body.h"
#include "model/body_kind.h"
#include "model/key.h"
#include "model/site.h"

static const struct key keys[] = {
    {"radius", KEY_NUMBER, &limit_length, true, KEY_OF(body, radius), .instead = {"diameter"},
     KEY_SAYS("diameter stands instead", "its radius")},
    {"diameter", KEY_TWICE, &limit_diameter, KEY_OF(body, radius),
     KEY_SAYS("radius stands instead", "twice the radius")},
};

static enum percuss_status sphere_complete(struct body *body, struct fault *fault)
{
    (void)fault;
    double r = body->radius;
    body->mass = 4.0 / 3.0 * M_PI * r * r * r * body->material.density;
    for (int i = 0; i < 3; i++)
        body->inertia[i] = 0.4 * body->mass * r * r;
    return PERCUSS_OK;
}

static double sphere_smallest_radius(const struct body *body)
{
    return body->radius;
}

static int sphere_faces(const struct body *body, const double p[3], struct face *faces)
{
    face_ball(0.0, body->radius, p, &faces[0]);
    return 1;
}

static struct solid sphere_solid(const struct body *body)
{
    return (struct solid){.form = SOLID_BALL, .radius = body->radius, .across = body->radius};
}

static void sphere_describe(const struct body *body, struct body_description *description)
{
    describe_extents(description, body->radius, body->radius, body->radius);
    describe_add(description, "radius %g m", body->radius);
}

const struct body_kind sphere_kind = {
    .name = "sphere",
    .keys = keys,
    .key_count = sizeof keys / sizeof *keys,
    .complete = sphere_complete,
    .smallest_radius = sphere_smallest_radius,
    .faces = sphere_faces,
    .solid = sphere_solid,
    .describe = sphere_describe,
};
