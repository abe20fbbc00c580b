/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "model/bar.h"
#include "model/body.h"
#include "model/body_kind.h"
#include "model/damping.h"
#include "model/key.h"
#include "model/mesh_family.h"
#include "model/ritz.h"
#include "model/site.h"

static const char *const ends[] = {
    [SUPPORT_FREE] = "free",
    [SUPPORT_CLAMPED] = "clamped",
};
static const struct key keys[] = {
    {"size", KEY_NUMBERS, &limit_length, true, KEY_OF(body, size),
     KEY_SAYS(NULL, "its edges along x, y and z")},
    {"ends", KEY_ENDS, KEY_OF(body, supports), KEY_WORDS(ends),
     .allowed = "one of free, clamped, or two of them, at -x and at +x: [clamped, free], also "
                "written clamped-free or cantilever; the end of a block has no pin: clamp it, or "
                "use a beam",
     KEY_SAYS("free", "how its faces at -x and +x are held: nothing moves on a clamped one")},
    BOX_VIBRATION_KEYS,
};

static bool is_held(const struct body *body)
{
    return body->supports[0] != SUPPORT_FREE || body->supports[1] != SUPPORT_FREE;
}

/* A held block moves by its vibration alone. */
static enum percuss_status block_check(const struct body *body, struct fault *fault)
{
    struct ritz_shape shape;
    if (!is_held(body))
        return PERCUSS_OK;
    if (body->rigid)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "rigid: true: must be false where an end is held: a held block moves by "
                         "its vibration alone");
    if (!mesh_family_box(body, &shape))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "ends: must be free where the block is thinner than 1/200 of its longest "
                         "side: its vibration is not computed");
    return PERCUSS_OK;
}

static enum percuss_status block_complete(struct body *body, struct fault *fault)
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

static double block_smallest_radius(const struct body *body)
{
    return 0.5 * fmin(body->size[0], fmin(body->size[1], body->size[2]));
}

static int block_faces(const struct body *body, const double p[3], struct face *faces)
{
    const double half[3] = {0.5 * body->size[0], 0.5 * body->size[1], 0.5 * body->size[2]};
    return face_box(half, p, faces);
}

/* Hit on its faces along z. */
static struct solid block_solid(const struct body *body)
{
    return (struct solid){.form = SOLID_CYLINDER,
                          .axis = 2,
                          .radius = sqrt(body->size[0] * body->size[1] / M_PI),
                          .length = body->size[2],
                          .across = fmin(body->size[0], body->size[1]),
                          .tip_radius = INFINITY,
                          .approximate = true};
}

static void block_describe(const struct body *body, struct body_description *description)
{
    const double *size = body->size;
    describe_extents(description, 0.5 * size[0], 0.5 * size[1], 0.5 * size[2]);
    describe_add(description, "%g m x %g m x %g m", size[0], size[1], size[2]);
    if (body->rigid)
        describe_add(description, "rigid");
    if (is_held(body))
        describe_add(description, "ends %s and %s", ends[body->supports[0]],
                     ends[body->supports[1]]);
    damping_describe(body, description);
    if (body->modes > 0)
        describe_add(description, "%u modes taking part", body->modes);
}

const struct body_kind block_kind = {
    .name = "block",
    .keys = keys,
    .key_count = sizeof keys / sizeof *keys,
    .check = block_check,
    .complete = block_complete,
    .smallest_radius = block_smallest_radius,
    .faces = block_faces,
    .why_not = bar_why_not,
    .solid = block_solid,
    .box = mesh_family_box,
    BOX_VIBRATION,
    .describe = block_describe,
};
