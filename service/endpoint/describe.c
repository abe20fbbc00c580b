/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/describe.h"

#include <stdio.h>
#include <string.h>

#include "model/describe.h"

void describe_body(const struct body *body, percuss_v1_Body *wire)
{
    struct body_description description = {.text = ""};
    *wire = (percuss_v1_Body){.mass = body->mass, .radius = body->radius};
    for (int i = 0; i < PERCUSS_PARAMETER_COUNT; i++)
        wire->parameters[i] = body_parameter(body, i);
    for (int end = 0; end < 2; end++)
        wire->supports[end] = body->supports[end];
    snprintf(wire->id, sizeof wire->id, "%s", body->id);
    snprintf(wire->shape, sizeof wire->shape, "%s", body->kind->name);
    snprintf(wire->material, sizeof wire->material, "%s", body->material.name);
    body->kind->describe(body, &description);
    memcpy(wire->half_extents, description.half_extents, sizeof wire->half_extents);
    wire->tip_radius = description.tip_radius;
    snprintf(wire->description, sizeof wire->description, "%s", description.text);
}
