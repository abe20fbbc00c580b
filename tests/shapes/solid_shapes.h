/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Meshes of simple bodies, made in memory: for solid_mesh_free. One part, "body", of the given
 * material; sets "low" and "high" of the end faces, sorted as every set. Elements follow curved
 * boundaries with all their nodes. */
#ifndef PERCUSS_TEST_SOLID_SHAPES_H
#define PERCUSS_TEST_SOLID_SHAPES_H

#include "mesh/solid_mesh.h"

/* A block from the origin to `size`, of so many cells along each axis: a hexahedron each, or 24
 * tetrahedra. Ends are across x. */
void solid_shape_block(enum element_type type, const double size[3], const size_t cells[3],
                       const struct material *material, struct solid_mesh *mesh);

/* A cylinder about the x axis from x = 0 to `length`: a square core of 2 n x 2 n cells and around
 * it `rings` of cells, `along` layers. */
void solid_shape_cylinder(enum element_type type, const double radius_length[2],
                          const size_t core_rings_along[3], const struct material *material,
                          struct solid_mesh *mesh);

#endif
