/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/complete_body.h"

#include <math.h>

enum percuss_status complete_body_make(const struct body *body, struct complete_body *complete,
                                       struct fault *fault)
{
    *complete = (struct complete_body){
        .shape = COMPLETE_CYLINDER,
        .radius = body->radius,
        .length = body->length,
        .material = body->material,
    };
    switch (body->shape) {
    case SHAPE_SPHERE:
        complete->shape = COMPLETE_SPHERE;
        break;
    case SHAPE_ROD:
        if (isfinite(body->tip_radius))
            return fault_set(
                fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                "%s: tip_radius: %g: complete finite elements have rods with flat ends", body->id,
                body->tip_radius);
        break;
    case SHAPE_CYLINDER:
        break;
    case SHAPE_BLOCK:
        complete->radius = sqrt(body->size[0] * body->size[1] / M_PI);
        complete->length = body->size[2];
        break;
    default:
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s: shape: %s: complete finite elements have sphere, rod, cylinder and "
                         "block",
                         body->id, shape_name(body->shape));
    }
    if (body->shape == SHAPE_ROD &&
        (body->supports[0] != SUPPORT_FREE || body->supports[1] != SUPPORT_FREE))
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s: supports: complete finite elements have free bodies only", body->id);
    if (body->damping > 0.0)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s: damping: %g: complete finite elements have no damping", body->id,
                         body->damping);
    return PERCUSS_OK;
}
