/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Places on the surface of a reduced body: the one nearest to a point, and the properties of the
 * surface there. In the frame and size of the file. */
#ifndef PERCUSS_MODEL_MESH_SURFACE_H
#define PERCUSS_MODEL_MESH_SURFACE_H

#include <stdbool.h>

#include "model/mesh_body.h"

/* The nearest place of one patch. */
struct mesh_place {
    unsigned face;
    double u, v;     /* on it, see facet.h */
    double point[3]; /* m */
    double distance; /* from the given point, >= 0, m */
    double to_rim;   /* from the patch's nearest sharp edge, m; INFINITY: it has none */
};

/* Properties of the surface at a place, interpolated between the nodes of its face. */
struct mesh_spot {
    double normal[3];    /* outward, unit */
    double curvature[9]; /* symmetric, across the normal, 1/m */
    double doubt;        /* of the normal, rad */
    double flexibility;  /* m/N, see struct mesh_body_face; NAN: not known */
    double slope;
    double tensor[6]; /* the same between all directions; NAN: not known */
    bool unsolved;    /* the flexibility: nobody has asked for it there (mesh_body_is_later) */
};

/* Makes the search structures of a body. False: out of memory. */
bool mesh_surface_prepare(struct mesh_body *body);

/* Writes the nearest place and, if it is within `beside` of an edge, the nearest places of other
 * patches that are at most `beside` farther, by distance. Returns their number, at most `most`. */
int mesh_surface_find(const struct mesh_body *body, const double p[3], double beside,
                      struct mesh_place *places, int most);

/* Size of a face: the longest of its edges, from corner to corner, m. */
double mesh_surface_face_size(const struct mesh_body *body, unsigned face);

/* Its flexibility is that of the faces or, of a body whose sites are solved for later, that of the
 * added site there. */
struct mesh_spot mesh_surface_at(const struct mesh_body *body, unsigned face, double u, double v);

#endif
