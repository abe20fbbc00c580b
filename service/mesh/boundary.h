/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The faces of elements, and which of them are the body's. */
#ifndef PERCUSS_MESH_BOUNDARY_H
#define PERCUSS_MESH_BOUNDARY_H

#include "mesh/solid_mesh.h"
#include "model/facet.h"

/* Three corners, then the mid nodes of edges 01 12 20; or four corners, mid nodes of 01 12 23 30,
 * and the middle. Corners run anticlockwise seen from outside. */
enum surface_face_type { FACE_TRIANGLE6 = 6, FACE_QUAD8 = 8, FACE_QUAD9 = 9 };
enum { FACE_MOST_NODES = FACET_MOST_NODES };

struct surface_face {
    unsigned char count;           /* enum surface_face_type */
    size_t nodes[FACE_MOST_NODES]; /* of the mesh */
    size_t element, part;          /* the element and part below it */
    size_t patch;                  /* faces of one patch meet smoothly */
};

/* The faces that belong to one element only, in the order of elements, as an array to be freed;
 * patch 0. PERCUSS_BAD_REQUEST: three elements share a face, or two do with other mid nodes. */
enum percuss_status boundary_faces(const struct solid_mesh *mesh, struct surface_face **faces,
                                   size_t *count, struct fault *fault);

/* Elements that hang together by whole faces, in `parent` [element_count] as of mesh/joined.h. */
enum percuss_status boundary_join(const struct solid_mesh *mesh, size_t *parent,
                                  struct fault *fault);

#endif
