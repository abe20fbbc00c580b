/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/site.h"

#include <string.h>

#include "model/vector.h"

void face_plane(int axis, double sign, double offset, const double p[3], struct face *face)
{
    *face = (struct face){.kind = SITE_ROUND, .beyond = -INFINITY};
    face->outward[axis] = sign;
    face->distance = sign * p[axis] - offset;
}

void face_ball(double x, double radius, const double p[3], struct face *face)
{
    *face = (struct face){.kind = SITE_ROUND, .beyond = -INFINITY};
    double d[3] = {p[0] - x, p[1], p[2]};
    double length = norm3(d);
    face->distance = length - radius;
    if (length > 0.0)
        scale3(1.0 / length, d, face->outward);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            face->curvature[3 * i + j] = ((i == j) - face->outward[i] * face->outward[j]) / radius;
}

void face_bar_side(double radius, double half_length, const double p[3], struct face *face)
{
    *face = (struct face){.kind = SITE_ROUND, .beyond = fabs(p[0]) - half_length};
    double rho = hypot(p[1], p[2]);
    face->distance = rho - radius;
    if (!(rho > 0.0))
        return;
    face->outward[1] = p[1] / rho;
    face->outward[2] = p[2] / rho;
    double around[3] = {0.0, -face->outward[2], face->outward[1]};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            face->curvature[3 * i + j] = around[i] * around[j] / radius;
}

int face_box(const double half[3], const double p[3], struct face *faces)
{
    for (int i = 0; i < 6; i++) {
        int axis = i / 2;
        int u = (axis + 1) % 3;
        int v = (axis + 2) % 3;
        face_plane(axis, i % 2 == 0 ? -1.0 : 1.0, half[axis], p, &faces[i]);
        faces[i].beyond = fmax(fabs(p[u]) - half[u], fabs(p[v]) - half[v]);
    }
    return 6;
}

static double angle_degrees(const double a[3], const double b[3])
{
    double c[3];
    cross3(a, b, c);
    return atan2(norm3(c), dot3(a, b)) * 180.0 / M_PI;
}

/* The face nearest in angle among those that have the point within `allowed`; NULL: none. */
static const struct face *best_face(const struct face *faces, int count, const double outward[3],
                                    double allowed)
{
    const struct face *best = NULL;
    for (int i = 0; i < count; i++) {
        if (!(fabs(faces[i].distance) <= allowed && faces[i].beyond <= allowed))
            continue;
        if (!best || dot3(faces[i].outward, outward) > dot3(best->outward, outward))
            best = &faces[i];
    }
    return best;
}

static enum percuss_status off_surface(const struct body *body, const struct face *faces, int count,
                                       double allowed, size_t contact, struct fault *fault)
{
    double nearest = INFINITY;
    for (int i = 0; i < count; i++)
        nearest = fmin(nearest, fmax(fabs(faces[i].distance), faces[i].beyond));
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "contacts[%zu].point: lies %.3g m off the surface of %s: at most %.3g m (10 %% of the "
        "smallest radius) is allowed",
        contact, nearest, body->id, allowed);
}

static enum percuss_status askew(const struct body *body, const struct face *face,
                                 const double outward[3], bool edge, size_t contact,
                                 struct fault *fault)
{
    double angle = angle_degrees(face->outward, outward);
    if (edge && angle < 95.0)
        return fault_set(
            fault, PERCUSS_UNSUPPORTED_GEOMETRY,
            "contacts[%zu].point: on an edge of %s: only a point contact of two smooth surfaces "
            "is supported",
            contact, body->id);
    if (angle > 135.0)
        return fault_set(
            fault, PERCUSS_BAD_REQUEST,
            "contacts[%zu].normal: points from a to b at %s: must be the unit vector from b to a",
            contact, body->id);
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "contacts[%zu].normal: %.3g degrees off the surface's normal of %s: at most %g degrees "
        "are allowed",
        contact, angle, body->id, SITE_MAX_ANGLE_DEGREES);
}

enum percuss_status site_locate(const struct body *body, const struct pose *pose,
                                const double point[3], const double outward[3], double allowed,
                                size_t contact, struct site *site, struct fault *fault)
{
    struct face faces[BODY_MOST_FACES];
    double from_centre[3];
    double direction[3];
    sub3(point, pose->position, from_centre);
    rotate_back3(pose->rotation, from_centre, site->point);
    rotate_back3(pose->rotation, outward, direction);

    int count = body->kind->faces(body, site->point, faces);
    const struct face *face = best_face(faces, count, direction, allowed);
    if (!face)
        return off_surface(body, faces, count, allowed, contact, fault);

    int near = 0;
    for (int i = 0; i < count; i++)
        near += fabs(faces[i].distance) <= allowed && faces[i].beyond <= allowed;
    if (angle_degrees(face->outward, direction) > SITE_MAX_ANGLE_DEGREES)
        return askew(body, face, direction, near > 1, contact, fault);

    /* past the edge by more than rounding: no smooth surface there */
    if (face->beyond > 1e-9 * body_smallest_radius(body))
        return fault_set(
            fault, PERCUSS_UNSUPPORTED_GEOMETRY,
            "contacts[%zu].point: %.3g m beyond the edge of the face of %s: only a point contact "
            "of two smooth surfaces is supported",
            contact, face->beyond, body->id);
    site->face = face->kind;
    memcpy(site->outward, face->outward, sizeof site->outward);
    memcpy(site->curvature, face->curvature, sizeof site->curvature);
    site->distance = face->distance;
    site->spot = face->spot;
    site->at_edge = face->beyond > -allowed;

    const char *why = body->kind->why_not ? body->kind->why_not(body, site) : NULL;
    if (why && site->spot.on_mesh)
        return fault_set(
            fault, PERCUSS_UNSUPPORTED_GEOMETRY,
            "contacts[%zu].point: on %s %s, %.3g m from an edge, where elements are %.3g m long: "
            "%s",
            contact, body->kind->name, body->id, site->spot.edge, site->spot.element, why);
    if (why)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY, "contacts[%zu].point: on %s %s: %s",
                         contact, body->kind->name, body->id, why);
    return PERCUSS_OK;
}

/* Any unit vector across n. */
static void tangents(const double n[3], double t[2][3])
{
    int smallest = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(n[i]) < fabs(n[smallest]))
            smallest = i;
    double axis[3] = {0.0, 0.0, 0.0};
    axis[smallest] = 1.0;
    cross3(n, axis, t[0]);
    scale3(1.0 / norm3(t[0]), t[0], t[0]);
    cross3(n, t[0], t[1]);
}

static void add_curvature(const struct site *site, const struct pose *pose, double t[2][3],
                          double sum[3])
{
    double local[2][3];
    double image[2][3];
    for (int i = 0; i < 2; i++) {
        rotate_back3(pose->rotation, t[i], local[i]);
        rotate3(site->curvature, local[i], image[i]);
    }
    sum[0] += dot3(local[0], image[0]);
    sum[1] += dot3(local[0], image[1]);
    sum[2] += dot3(local[1], image[1]);
}

void site_relative_curvature(const struct site *a, const struct pose *pose_a, const struct site *b,
                             const struct pose *pose_b, const double normal[3], double curvature[2])
{
    double t[2][3];
    double sum[3] = {0.0, 0.0, 0.0};
    tangents(normal, t);
    add_curvature(a, pose_a, t, sum);
    add_curvature(b, pose_b, t, sum);
    double mean = 0.5 * (sum[0] + sum[2]);
    double spread = hypot(0.5 * (sum[0] - sum[2]), sum[1]);
    curvature[0] = 0.5 * (mean - spread);
    curvature[1] = 0.5 * (mean + spread);
}

void site_least_direction(const struct site *a, const struct pose *pose_a, const struct site *b,
                          const struct pose *pose_b, const double normal[3], double direction[3])
{
    double t[2][3];
    double sum[3] = {0.0, 0.0, 0.0};
    tangents(normal, t);
    add_curvature(a, pose_a, t, sum);
    add_curvature(b, pose_b, t, sum);
    /* across the direction of the larger one */
    double angle = 0.5 * atan2(2.0 * sum[1], sum[0] - sum[2]) + M_PI_2;
    scale3(cos(angle), t[0], direction);
    add_scaled3(sin(angle), t[1], direction);
}

void site_least_curvatures(const struct site *a, const struct pose *pose_a, const struct site *b,
                           const struct pose *pose_b, const double normal[3], double along[2])
{
    double turned[2][3];
    double own[3] = {0.0, 0.0, 0.0};
    site_least_direction(a, pose_a, b, pose_b, normal, turned[0]);
    cross3(normal, turned[0], turned[1]);
    add_curvature(a, pose_a, turned, own);
    along[0] = own[0];
    add_curvature(b, pose_b, turned, own);
    along[1] = own[0] - along[0];
}
