/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The surface of a mesh: its faces, outward normals and curvatures. */
#ifndef PERCUSS_MESH_SURFACE_H
#define PERCUSS_MESH_SURFACE_H

#include <stddef.h>

#include "mesh/solid_mesh.h"
#include "model/facet.h"

/* Three corners, then the mid nodes of edges 01 12 20; or four corners, mid nodes of 01 12 23 30,
 * and the middle. Corners run anticlockwise seen from outside. */
enum surface_face_type { FACE_TRIANGLE6 = 6, FACE_QUAD8 = 8, FACE_QUAD9 = 9 };
enum { FACE_MOST_NODES = FACET_MOST_NODES };

struct surface_face {
    unsigned char count;           /* enum surface_face_type */
    size_t nodes[FACE_MOST_NODES]; /* of the mesh */
    size_t element, part;          /* its element and part */
    size_t patch;                  /* faces of one patch meet smoothly */
};

static inline int surface_face_corners(const struct surface_face *face)
{
    return face->count == FACE_TRIANGLE6 ? 3 : 4;
}

/* Normal and curvature at one node of one face: faces that meet in a sharp edge differ. */
struct surface_point {
    double normal[3];    /* outward, unit */
    double curvature[9]; /* symmetric tensor, 1/m, > 0 where convex; as of struct site */
    double doubt;        /* angle between the normals of fits of two orders, rad */
};

/* Owns its arrays. */
struct surface {
    size_t face_count, patch_count;
    struct surface_face *faces;
    struct surface_point (*points)[FACE_MOST_NODES]; /* [face_count]; NULL before surface_fit */
    double size;                                     /* median distance of corners, m */
    size_t straight; /* edges on curved ground with a mid node on the chord (surface_fit) */
    size_t edges;    /* edges on curved ground (surface_fit) */
};

/* A place on the surface. */
struct surface_place {
    size_t face;
    struct facet_foot foot;
    double normal[3]; /* outward, of the face itself */
};

/* Faces that belong to one element only, outward where the element's det J > 0, in patches that end
 * where normals turn by more than 35 degrees at an edge. PERCUSS_BAD_REQUEST: faces that three
 * elements share, or two with other mid nodes. Free the surface with surface_free. */
enum percuss_status surface_make(const struct solid_mesh *mesh, struct surface *surface,
                                 struct fault *fault);

/* Normal and curvatures at every node of every face: polynomials of fourth order through the nodes
 * of the same patch that are within 2.5 to 4 edges, without mid nodes of straight edges on curved
 * ground. PERCUSS_INTERNAL: out of memory. */
enum percuss_status surface_fit(const struct solid_mesh *mesh, struct surface *surface,
                                struct fault *fault);

/* The place nearest to p (m, the mesh's frame). There is at least one face. */
struct surface_place surface_near(const struct solid_mesh *mesh, const struct surface *surface,
                                  const double p[3]);

/* Points of a face's nodes. */
void surface_face_points(const struct solid_mesh *mesh, const struct surface_face *face,
                         double points[FACE_MOST_NODES][3]);

void surface_free(struct surface *surface);

/* Joins elements that share a face, in `parent` [element_count] of mesh/joined.h. */
enum percuss_status boundary_join(const struct solid_mesh *mesh, size_t *parent,
                                  struct fault *fault);

#endif
