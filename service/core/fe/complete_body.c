/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/complete_body.h"

#include <math.h>

enum percuss_status complete_body_make(const struct body *body, struct complete_body *complete,
                                       struct fault *fault)
{
    struct solid solid = body_solid(body);
    /* a cylinder of its dimensions, other forms below */
    *complete = (struct complete_body){
        .shape = solid.form == SOLID_BALL ? COMPLETE_SPHERE : COMPLETE_CYLINDER,
        .radius = solid.radius,
        .length = solid.length,
        .material = body->material,
        .rate = body->yield_rate,
    };
    if (solid.form != SOLID_BALL && solid.form != SOLID_CYLINDER)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s: shape: %s: complete finite elements have sphere, rod, cylinder and "
                         "block",
                         body->id, body->kind->name);
    if (solid.form == SOLID_CYLINDER && isfinite(solid.tip_radius))
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s: tip_radius: %g: complete finite elements have rods with flat ends",
                         body->id, solid.tip_radius);
    /* supports and damping are not meshed */
    if (body->supports[0] != SUPPORT_FREE || body->supports[1] != SUPPORT_FREE)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s: supports: complete finite elements have free bodies only", body->id);
    if (body->damping > 0.0)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s: damping: %g: complete finite elements have no damping", body->id,
                         body->damping);
    return PERCUSS_OK;
}
