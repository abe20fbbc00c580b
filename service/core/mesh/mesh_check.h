/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Checks that a mesh is one body that can be computed, and measures it. */
#ifndef PERCUSS_MESH_MESH_CHECK_H
#define PERCUSS_MESH_MESH_CHECK_H

#include "mesh/surface.h"

enum { MESH_REMARKS = 6 };

struct mesh_findings {
    double least_jacobian; /* over all elements: least det J over its mean within the element */
    size_t least_element;  /* its element: the file's number */
    double extent[3];      /* of the box about it, m */
    double volume;         /* m^3 */
    size_t remark_count;   /* warnings */
    char remarks[MESH_REMARKS][MESH_REMARK_SIZE];
};

/* PERCUSS_BAD_REQUEST: inverted elements (det J <= 0 at a point of quadrature or a node), duplicate
 * nodes, elements that meet without sharing a face, separate parts, no elements; the message has
 * their number, an example and the remedy. `surface` is that of surface_make; after surface_fit a
 * remark tells of straight-sided elements on curved ground. */
enum percuss_status mesh_check(const struct solid_mesh *mesh, const struct surface *surface,
                               struct mesh_findings *findings, struct fault *fault);

#endif
