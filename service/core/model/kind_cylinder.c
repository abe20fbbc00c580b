/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "model/bar.h"
#include "model/damping.h"
#include "model/key.h"
#include "model/mesh_family.h"
#include "model/ritz.h"

static const struct key keys[] = {
    {"radius", KEY_NUMBER, &limit_length, true, KEY_OF(body, radius), .instead = {"diameter"},
     KEY_SAYS("diameter stands instead", "its radius")},
    {"diameter", KEY_TWICE, &limit_diameter, KEY_OF(body, radius),
     KEY_SAYS("radius stands instead", "twice the radius")},
    {"length", KEY_NUMBER, &limit_length, true, KEY_OF(body, length),
     KEY_SAYS(NULL, "along its axis, which is x")},
    BOX_VIBRATION_KEYS,
};

static enum percuss_status cylinder_complete(struct body *body, struct fault *fault)
{
    (void)fault;
    bar_complete_round(body);
    return PERCUSS_OK;
}

static double cylinder_smallest_radius(const struct body *body)
{
    return fmin(body->radius, 0.5 * body->length);
}

static int cylinder_faces(const struct body *body, const double p[3], struct face *faces)
{
    return bar_round_faces(body, INFINITY, p, faces);
}

static bool cylinder_box(const struct body *body, struct ritz_shape *shape)
{
    double diameter = 2.0 * body->radius;
    *shape = (struct ritz_shape){.side = {body->length, diameter, diameter}, .round = true};
    return ritz_reaches(shape);
}

static struct solid cylinder_solid(const struct body *body)
{
    return (struct solid){.form = SOLID_CYLINDER,
                          .radius = body->radius,
                          .length = body->length,
                          .across = body->radius,
                          .tip_radius = INFINITY};
}

static void cylinder_describe(const struct body *body, struct body_description *description)
{
    describe_extents(description, 0.5 * body->length, body->radius, body->radius);
    describe_add(description, "length %g m", body->length);
    describe_add(description, "radius %g m", body->radius);
    if (body->rigid)
        describe_add(description, "rigid");
    damping_describe(body, description);
    if (body->modes > 0)
        describe_add(description, "%u modes taking part", body->modes);
}

const struct body_kind cylinder_kind = {
    .name = "cylinder",
    .keys = keys,
    .key_count = sizeof keys / sizeof *keys,
    .complete = cylinder_complete,
    .smallest_radius = cylinder_smallest_radius,
    .faces = cylinder_faces,
    .solid = cylinder_solid,
    .box = cylinder_box,
    BOX_VIBRATION,
    .describe = cylinder_describe,
};
