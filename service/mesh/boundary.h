/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The faces of elements, and which of them are the body's. */
#ifndef PERCUSS_MESH_BOUNDARY_H
#define PERCUSS_MESH_BOUNDARY_H

#include "mesh/surface.h"

/* The faces that belong to one element only, in the order of elements, as an array to be freed;
 * patch 0. PERCUSS_BAD_REQUEST: three elements share a face, or two do with other mid nodes. */
enum percuss_status boundary_faces(const struct solid_mesh *mesh, struct surface_face **faces,
                                   size_t *count, struct fault *fault);

#endif
