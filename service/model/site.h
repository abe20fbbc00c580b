/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where on a body a contact is: from a point and a normal in the world to a place on its surface.
 */
#ifndef PERCUSS_MODEL_SITE_H
#define PERCUSS_MODEL_SITE_H

#include "base/fault.h"
#include "model/body.h"
#include "model/face.h"

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
