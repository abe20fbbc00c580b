/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The surface of a mesh: its faces, outward normals and curvatures. */
#ifndef PERCUSS_MESH_SURFACE_H
#define PERCUSS_MESH_SURFACE_H

#include <stddef.h>

/* Three corners, then the mid nodes of edges 01 12 20; or four corners, mid nodes of 01 12 23 30,
 * and the middle. Corners run anticlockwise seen from outside. */
enum surface_face_type { FACE_TRIANGLE6 = 6, FACE_QUAD8 = 8, FACE_QUAD9 = 9 };
enum { FACE_MOST_NODES = 9 };

/* What the surface is like at one node of one face: faces that meet in a sharp edge differ. */
struct surface_point {
    double normal[3];    /* outward, unit */
    double curvature[9]; /* symmetric tensor, 1/m, > 0 where convex; as of struct site */
    double doubt;        /* how far a fit differs from the nodes' normals: rad */
};

struct surface_face {
    unsigned char count;           /* enum surface_face_type */
    size_t nodes[FACE_MOST_NODES]; /* of the mesh */
    size_t element, part;          /* the element and part below it */
    size_t patch;                  /* faces of one patch meet smoothly */
};

/* Owns its arrays. */
struct surface {
    size_t face_count, patch_count;
    struct surface_face *faces;
    struct surface_point (*points)[FACE_MOST_NODES]; /* [face_count]; NULL before surface_fit */
    double size;                                     /* median length of the edges, m */
};

#endif
