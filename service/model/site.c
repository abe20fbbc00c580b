/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/site.h"

#include <string.h>

#include "model/vector.h"

/* One smooth piece of a surface near the point in question. */
struct face {
    enum site_face kind;
    double outward[3];
    double curvature[9];
    double distance; /* of the point, along the outward normal */
    double beyond;   /* how far the foot of the point lies beyond the face's edge; <= 0: on it */
};

enum { MAX_FACES = 6 };

static void add_plane(struct face *face, int axis, double sign, double offset, const double p[3])
{
    *face = (struct face){.kind = SITE_ROUND, .beyond = -INFINITY};
    face->outward[axis] = sign;
    face->distance = sign * p[axis] - offset;
}

/* Sphere of a radius about (x, 0, 0). */
static void add_ball(struct face *face, double x, double radius, const double p[3])
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

/* Lateral surface of a round bar along x. */
static void add_side(struct face *face, double radius, double half_length, const double p[3])
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

static int round_bar_faces(const struct body *body, const double p[3], struct face *faces)
{
    double half = 0.5 * body->length;
    bool tipped = body->shape == SHAPE_ROD && isfinite(body->tip_radius);
    for (int end = 0; end < 2; end++) {
        double sign = end == 0 ? -1.0 : 1.0;
        if (tipped)
            add_ball(&faces[end], sign * (half - body->tip_radius), body->tip_radius, p);
        else
            add_plane(&faces[end], 0, sign, half, p);
        faces[end].kind = SITE_END;
        faces[end].beyond = sign * p[0] > 0.0 ? hypot(p[1], p[2]) - body->radius : INFINITY;
    }
    add_side(&faces[2], body->radius, half, p);
    if (body->shape != SHAPE_CYLINDER)
        faces[2].kind = SITE_BEAM_SIDE;
    return 3;
}

static int box_faces(const double half[3], bool is_beam, const double p[3], struct face *faces)
{
    for (int i = 0; i < 6; i++) {
        int axis = i / 2;
        int u = (axis + 1) % 3;
        int v = (axis + 2) % 3;
        add_plane(&faces[i], axis, i % 2 == 0 ? -1.0 : 1.0, half[axis], p);
        faces[i].beyond = fmax(fabs(p[u]) - half[u], fabs(p[v]) - half[v]);
        if (is_beam)
            faces[i].kind = axis == 0 ? SITE_END : SITE_BEAM_SIDE;
    }
    return 6;
}

static int body_faces(const struct body *body, const double p[3], struct face *faces)
{
    switch (body->shape) {
    case SHAPE_SPHERE:
        add_ball(faces, 0.0, body->radius, p);
        return 1;
    case SHAPE_HALF_SPACE:
        add_plane(faces, 2, 1.0, 0.0, p);
        return 1;
    case SHAPE_BLOCK: {
        double half[3] = {0.5 * body->size[0], 0.5 * body->size[1], 0.5 * body->size[2]};
        return box_faces(half, false, p, faces);
    }
    case SHAPE_BEAM:
        if (body->radius == 0.0) {
            double half[3] = {0.5 * body->length, 0.5 * body->width, 0.5 * body->height};
            return box_faces(half, true, p, faces);
        }
        return round_bar_faces(body, p, faces);
    case SHAPE_ROD:
    case SHAPE_CYLINDER:
        return round_bar_faces(body, p, faces);
    }
    return 0;
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
                                       double allowed, const char *field, struct fault *fault)
{
    double nearest = INFINITY;
    for (int i = 0; i < count; i++)
        nearest = fmin(nearest, fmax(fabs(faces[i].distance), faces[i].beyond));
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%s.point: lies %.3g m off the surface of %s: at most %.3g m (10 %% of the "
                     "smallest radius) is allowed",
                     field, nearest, body->id, allowed);
}

static enum percuss_status askew(const struct body *body, const struct face *face,
                                 const double outward[3], bool edge, const char *field,
                                 struct fault *fault)
{
    double angle = angle_degrees(face->outward, outward);
    if (edge && angle < 95.0)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s.point: on an edge of %s: only a point contact of two smooth surfaces "
                         "is supported",
                         field, body->id);
    if (angle > 135.0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%s.normal: points from a to b at %s: must be the unit vector from b to a",
                         field, body->id);
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%s.normal: %.3g degrees off the surface's normal of %s: at most %g degrees "
                     "are allowed",
                     field, angle, body->id, SITE_MAX_ANGLE_DEGREES);
}

/* What can be met in the geometry but not in the models: message, or NULL. */
static const char *unsupported(const struct body *body, const struct site *site)
{
    bool bar = body->shape == SHAPE_ROD || body->shape == SHAPE_BEAM;
    double eccentricity = hypot(site->point[1], site->point[2]);
    if (body->shape == SHAPE_ROD && site->face == SITE_BEAM_SIDE)
        return "a hit on the side bends it, and a rod has longitudinal waves only: declare it as "
               "shape: beam";
    if (body->shape == SHAPE_ROD && eccentricity > 0.1 * body->radius)
        return "a hit beside the axis bends it (more than 10 % of the radius), and a rod has "
               "longitudinal waves only: declare it as shape: beam";
    if (bar && site->face == SITE_END && body->supports[site->point[0] > 0.0] != SUPPORT_FREE)
        return "this end is held by a support: hit the free end or the side";
    return NULL;
}

enum percuss_status site_locate(const struct body *body, const struct pose *pose,
                                const double point[3], const double outward[3], double allowed,
                                const char *field, struct site *site, struct fault *fault)
{
    struct face faces[MAX_FACES];
    double from_centre[3];
    double direction[3];
    memset(site, 0, sizeof *site);
    sub3(point, pose->position, from_centre);
    rotate_back3(pose->rotation, from_centre, site->point);
    rotate_back3(pose->rotation, outward, direction);

    int count = body_faces(body, site->point, faces);
    const struct face *face = best_face(faces, count, direction, allowed);
    if (!face)
        return off_surface(body, faces, count, allowed, field, fault);

    int near = 0;
    for (int i = 0; i < count; i++)
        near += fabs(faces[i].distance) <= allowed && faces[i].beyond <= allowed;
    if (angle_degrees(face->outward, direction) > SITE_MAX_ANGLE_DEGREES)
        return askew(body, face, direction, near > 1, field, fault);

    /* past the edge by more than rounding: no smooth surface there */
    if (face->beyond > 1e-9 * body_smallest_radius(body))
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "%s.point: %.3g m beyond the edge of the face of %s: only a point contact "
                         "of two smooth surfaces is supported",
                         field, face->beyond, body->id);
    site->face = face->kind;
    memcpy(site->outward, face->outward, sizeof site->outward);
    memcpy(site->curvature, face->curvature, sizeof site->curvature);
    site->distance = face->distance;
    site->at_edge = face->beyond > -allowed;

    const char *why = unsupported(body, site);
    if (why)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY, "%s.point: on %s %s: %s", field,
                         shape_name(body->shape), body->id, why);
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
