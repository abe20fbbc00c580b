/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies of the catalogue as bodies of a complete finite-element impact. */
#ifndef PERCUSS_FE_COMPLETE_BODY_H
#define PERCUSS_FE_COMPLETE_BODY_H

#include "base/fault.h"
#include "model/body.h"

enum complete_shape { COMPLETE_SPHERE, COMPLETE_CYLINDER };

/* A cylinder is hit in the middle of its end face: rod, compact cylinder, disc, or a block taken as
 * a cylinder. Free in space. */
struct complete_body {
    enum complete_shape shape;
    double radius, length; /* m; length of a cylinder only */
    struct material material;
    struct yield_rate rate; /* each point has the yield stress of its own rate of plastic strain */
};

/* A sphere, a free rod with flat ends, a compact cylinder hit on its end, or a block hit on its
 * face z = +-size[2]/2 and taken as a cylinder of the same section. OK, or UNSUPPORTED_GEOMETRY
 * naming the property that cannot be meshed: other shapes, rounded tips, supports, damping. */
enum percuss_status complete_body_make(const struct body *body, struct complete_body *complete,
                                       struct fault *fault);

#endif
