/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/describe.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void add(percuss_v1_Body *wire, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* One more thing to say, after a comma. */
static void add(percuss_v1_Body *wire, const char *format, ...)
{
    size_t used = strlen(wire->description);
    if (used > 0 && used + 3 < sizeof wire->description) {
        memcpy(wire->description + used, ", ", 3);
        used += 2;
    }
    va_list args;
    va_start(args, format);
    vsnprintf(wire->description + used, sizeof wire->description - used, format, args);
    va_end(args);
}

static void set_half_extents(percuss_v1_Body *wire, double x, double y, double z)
{
    wire->half_extents[0] = x;
    wire->half_extents[1] = y;
    wire->half_extents[2] = z;
}

static void describe_ends(const struct body *body, percuss_v1_Body *wire)
{
    static const char *const names[] = {"free", "pinned", "clamped"};
    for (int i = 0; i < 2; i++)
        wire->supports[i] = body->supports[i];
    add(wire, "ends %s and %s", names[body->supports[0]], names[body->supports[1]]);
    if (body->damping > 0.0)
        add(wire, "modal damping ratio %g", body->damping);
    if (body->modes > 0)
        add(wire, "%u modes", body->modes);
}

static void describe_rod(const struct body *body, percuss_v1_Body *wire)
{
    set_half_extents(wire, 0.5 * body->length, body->radius, body->radius);
    wire->tip_radius = body->tip_radius;
    add(wire, "length %g m", body->length);
    add(wire, "radius %g m", body->radius);
    if (isinf(body->tip_radius))
        add(wire, "flat tips");
    else
        add(wire, "tip radius %g m", body->tip_radius);
    if (body->lateral_inertia)
        add(wire, "lateral inertia");
    describe_ends(body, wire);
}

static void describe_beam(const struct body *body, percuss_v1_Body *wire)
{
    add(wire, "length %g m", body->length);
    if (body->radius > 0.0) {
        set_half_extents(wire, 0.5 * body->length, body->radius, body->radius);
        add(wire, "radius %g m", body->radius);
    } else {
        set_half_extents(wire, 0.5 * body->length, 0.5 * body->width, 0.5 * body->height);
        add(wire, "section %g m x %g m", body->width, body->height);
    }
    add(wire, "%s", body->theory == THEORY_TIMOSHENKO ? "Timoshenko" : "Euler-Bernoulli");
    if (body->theory == THEORY_TIMOSHENKO)
        add(wire, "shear factor %.4g", body->shear_factor[1]);
    describe_ends(body, wire);
}

static void describe_compact(const struct body *body, percuss_v1_Body *wire)
{
    if (body->shape == SHAPE_SPHERE) {
        set_half_extents(wire, body->radius, body->radius, body->radius);
        add(wire, "radius %g m", body->radius);
    } else if (body->shape == SHAPE_CYLINDER) {
        set_half_extents(wire, 0.5 * body->length, body->radius, body->radius);
        add(wire, "length %g m", body->length);
        add(wire, "radius %g m", body->radius);
    } else if (body->shape == SHAPE_BLOCK) {
        set_half_extents(wire, 0.5 * body->size[0], 0.5 * body->size[1], 0.5 * body->size[2]);
        add(wire, "%g m x %g m x %g m", body->size[0], body->size[1], body->size[2]);
    } else {
        add(wire, "fills z <= 0, immovable");
    }
}

void describe_body(const struct body *body, percuss_v1_Body *wire)
{
    *wire = (percuss_v1_Body){.mass = body->mass, .radius = body->radius};
    for (int i = 0; i < PERCUSS_PARAMETER_COUNT; i++)
        wire->parameters[i] = body_parameter(body, i);
    snprintf(wire->id, sizeof wire->id, "%s", body->id);
    snprintf(wire->shape, sizeof wire->shape, "%s", shape_name(body->shape));
    snprintf(wire->material, sizeof wire->material, "%s", body->material.name);
    if (body->shape == SHAPE_ROD)
        describe_rod(body, wire);
    else if (body->shape == SHAPE_BEAM)
        describe_beam(body, wire);
    else
        describe_compact(body, wire);
}
