/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stiffness and mass assembled by another program. */
#ifndef PERCUSS_MESH_MATRICES_READ_H
#define PERCUSS_MESH_MATRICES_READ_H

#include "mesh/matrices.h"

struct matrices_files {
    const char *stiffness, *mass; /* Matrix Market (.mtx), or lines "row column value" of one
                                   * triangle as CalculiX writes (.sti, .mas) */
    const char *freedoms;         /* lines "node.direction", one a row (.dof); NULL: the mesh's
                                   * nodes by number, directions 1 to 3 each */
};

/* Reads the matrices of `mesh`, a file of the same nodes in the same units (N, s, its length).
 * Directions without a row are held. PERCUSS_BAD_REQUEST: they do not fit the mesh, are not
 * symmetric, or have no mass of a body. */
enum percuss_status matrices_read(const struct matrices_files *files, const struct solid_mesh *mesh,
                                  struct matrices *matrices, struct fault *fault);

#endif
