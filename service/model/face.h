/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Smooth pieces of surfaces, as one point near them sees them. */
#ifndef PERCUSS_MODEL_FACE_H
#define PERCUSS_MODEL_FACE_H

#include <stdbool.h>

enum site_face {
    SITE_ROUND,     /* sphere, side of a cylinder, plane of a half-space or block */
    SITE_BEAM_SIDE, /* lateral surface of a rod or beam */
    SITE_END        /* end face or tip of a rod, beam or cylinder */
};

/* Where on a mesh's surface; all zero on other bodies. */
struct face_spot {
    bool on_mesh;
    unsigned facet, material;
    double u, v;        /* on the facet */
    double edge;        /* distance from the nearest sharp edge of its patch, m; INFINITY: none */
    double element;     /* how long the facet is, m */
    double doubt;       /* of the normal and the curvature, rad; 0 where they are declared */
    bool fitted;        /* the curvature is that of a fit, not declared */
    double flexibility; /* regular, m/N, see struct mesh_body_face; NAN: not known */
    double slope;
    const char *remark; /* of the named site there; NULL: none */
};

struct face {
    enum site_face kind;
    double outward[3];
    double curvature[9]; /* symmetric tensor, 1/m; 0 where flat */
    double distance;     /* of the point, along the outward normal */
    struct face_spot spot;
    double beyond; /* how far the foot of the point lies beyond the face's edge; <= 0: on it */
};

/* All in the body frame, for the point p; kind SITE_ROUND; a plane's and a ball's edges are to be
 * set by whoever knows them. */

/* The plane `offset` from the origin whose normal is the axis 0, 1, 2 with a sign. */
struct face face_plane(int axis, double sign, double offset, const double p[3]);

/* Sphere of a radius about (x, 0, 0). */
struct face face_ball(double x, double radius, const double p[3]);

/* Lateral surface of a round bar along x. */
struct face face_bar_side(double radius, double half_length, const double p[3]);

/* The six faces of a box about the origin; their number. */
int face_box(const double half[3], const double p[3], struct face *faces);

#endif
