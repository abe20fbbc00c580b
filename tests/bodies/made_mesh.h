/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Reduced bodies made without a mesh: the surface of a round bar with the modes that the built-in
 * rod or beam has in closed form, so that both must give the same answers. */
#ifndef PERCUSS_TEST_MADE_MESH_H
#define PERCUSS_TEST_MADE_MESH_H

#include "model/body.h"
#include "model/mesh_body.h"

struct made_mesh {
    const struct body *bar; /* rod or round beam, completed; both ends free or both held */
    size_t modes;           /* of each family */
    size_t removed;         /* modes without which flexibilities are stated */
    size_t around, along;   /* faces of the side, elements of the radius being around/8 */
    double end_flexibility; /* added at the ends, m/N */
};

/* NULL: out of memory. For mesh_body_free. */
struct mesh_body *made_mesh_bar(const struct made_mesh *wanted);

#endif
