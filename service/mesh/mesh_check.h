/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether a mesh is one body that can be computed, and what to know about it. */
#ifndef PERCUSS_MESH_MESH_CHECK_H
#define PERCUSS_MESH_MESH_CHECK_H

#include "mesh/surface.h"

enum { MESH_REMARKS = 6, MESH_REMARK_SIZE = 240 };

struct mesh_findings {
    double least_jacobian; /* over all elements: least det J over its mean within the element */
    size_t least_element;  /* where: the file's number */
    double extent[3];      /* of the box about it, m */
    double volume;         /* m^3 */
    size_t remark_count;   /* warnings */
    char remarks[MESH_REMARKS][MESH_REMARK_SIZE];
};

/* PERCUSS_BAD_REQUEST: elements that are turned inside out (det J <= 0 at a point of quadrature or
 * a node), nodes that are there twice, parts that do not hang together, nothing there; the message
 * says which, how many and what to do. `surface` is that of surface_make; where surface_fit has
 * been called too, straight-sided elements on round ground are remarked upon. */
enum percuss_status mesh_check(const struct solid_mesh *mesh, const struct surface *surface,
                               struct mesh_findings *findings, struct fault *fault);

#endif
