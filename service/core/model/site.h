/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The place of a contact on a body: from a point and a normal in the world to a place on its
 * surface. */
#ifndef PERCUSS_MODEL_SITE_H
#define PERCUSS_MODEL_SITE_H

#include <stdbool.h>

#include "base/fault.h"
#include "model/body.h"

/* Smooth pieces of a surface near a point. */
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
    double tensor[6];   /* the same between all directions, body frame; NAN: not known */
    bool unsolved;      /* the flexibility is not solved for yet: a caller that needs it refuses the
                           site */
    double foot[3];     /* the place in the mesh's own frame and unit */
    const char *remark; /* of the named site there; NULL: none */
};

struct face {
    enum site_face kind;
    double outward[3];
    double curvature[9]; /* symmetric tensor, 1/m; 0 where flat */
    double distance;     /* of the point, along the outward normal */
    struct face_spot spot;
    double beyond; /* distance of the point's foot beyond the face's edge; <= 0: on the face */
};

/* All in the body frame, for the point p; kind SITE_ROUND; the caller sets the edges of a plane and
 * a ball. */

/* The plane `offset` from the origin, normal to the axis 0, 1, 2, with a sign. */
void face_plane(int axis, double sign, double offset, const double p[3], struct face *face);

/* Sphere of a radius about (x, 0, 0). */
void face_ball(double x, double radius, const double p[3], struct face *face);

/* Lateral surface of a round bar along x. */
void face_bar_side(double radius, double half_length, const double p[3], struct face *face);

/* The six faces of a box about the origin; their number. */
int face_box(const double half[3], const double p[3], struct face *faces);

/* Largest angle between a stated normal and the surface's. */
#define SITE_MAX_ANGLE_DEGREES 5.0

struct pose {
    double position[3];
    double rotation[9]; /* row-major, world = rotation body */
};

struct site {
    enum site_face face;
    double point[3];     /* body frame */
    double outward[3];   /* the surface's normal, body frame */
    double curvature[9]; /* symmetric tensor, body frame, 1/m; 0 where flat */
    double distance;     /* of the stated point from the surface, > 0 outside */
    struct face_spot spot;
    bool at_edge; /* within the allowed distance of the surface's edge */
};

/* Finds the face of `body` that has `point` (world) within `allowed` metres and the surface normal
 * within SITE_MAX_ANGLE_DEGREES of `outward` (world, unit). Messages name the contact by its
 * index and the body by its id. PERCUSS_BAD_REQUEST: point off the surface or normal askew;
 * PERCUSS_UNSUPPORTED_GEOMETRY: an edge, the side of a rod, a held end. */
enum percuss_status site_locate(const struct body *body, const struct pose *pose,
                                const double point[3], const double outward[3], double allowed,
                                size_t contact, struct site *site, struct fault *fault);

/* The direction in the surface in which the sum of both surfaces' curvatures is least: the major
 * axis of the contact's ellipse. World, unit; sites in the frames of their poses. */
void site_least_direction(const struct site *a, const struct pose *pose_a, const struct site *b,
                          const struct pose *pose_b, const double normal[3], double direction[3]);

/* Curvatures (1/m, > 0 where convex) of both surfaces in the direction in which their sum is least;
 * as below. */
void site_least_curvatures(const struct site *a, const struct pose *pose_a, const struct site *b,
                           const struct pose *pose_b, const double normal[3], double along[2]);

/* Principal relative curvatures A <= B of the gap A x^2 + B y^2 between two surfaces that touch
 * with the world normal `normal`; sites in the frames of their poses. */
void site_relative_curvature(const struct site *a, const struct pose *pose_a, const struct site *b,
                             const struct pose *pose_b, const double normal[3],
                             double curvature[2]);

#endif
