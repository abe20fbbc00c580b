/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stiffness and mass of a mesh, consistent: degree of freedom 3 i + k moves node i along axis k. */
#ifndef PERCUSS_MESH_MATRICES_H
#define PERCUSS_MESH_MATRICES_H

#include "mesh/solid_mesh.h"
#include "mesh/sparse.h"

struct matrices {
    struct sparse stiffness, mass; /* N/m, kg; held degrees of freedom have only a stiffness, their
                                    * own: see sparse_hold */
    bool *held;                    /* [3 node_count]; NULL: none is */
    const struct solid_mesh *mesh; /* borrowed: what they were made of; NULL: of a file */
};

/* Linear elastic, each part of its material. PERCUSS_BAD_REQUEST: a node belongs to no element, or
 * the mesh has too many; PERCUSS_INTERNAL without memory. */
enum percuss_status matrices_make(const struct solid_mesh *mesh, struct matrices *matrices,
                                  struct fault *fault);

/* Holds all three directions of these nodes. PERCUSS_INTERNAL without memory. */
enum percuss_status matrices_hold(struct matrices *matrices, const struct mesh_set *set,
                                  struct fault *fault);

void matrices_free(struct matrices *matrices);

#endif
