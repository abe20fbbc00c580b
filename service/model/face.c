/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/face.h"

#include "model/vector.h"

struct face face_plane(int axis, double sign, double offset, const double p[3])
{
    struct face face = {.kind = SITE_ROUND, .beyond = -INFINITY};
    face.outward[axis] = sign;
    face.distance = sign * p[axis] - offset;
    return face;
}

struct face face_ball(double x, double radius, const double p[3])
{
    struct face face = {.kind = SITE_ROUND, .beyond = -INFINITY};
    double d[3] = {p[0] - x, p[1], p[2]};
    double length = norm3(d);
    face.distance = length - radius;
    if (length > 0.0)
        scale3(1.0 / length, d, face.outward);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            face.curvature[3 * i + j] = ((i == j) - face.outward[i] * face.outward[j]) / radius;
    return face;
}

struct face face_bar_side(double radius, double half_length, const double p[3])
{
    struct face face = {.kind = SITE_ROUND, .beyond = fabs(p[0]) - half_length};
    double rho = hypot(p[1], p[2]);
    face.distance = rho - radius;
    if (!(rho > 0.0))
        return face;
    face.outward[1] = p[1] / rho;
    face.outward[2] = p[2] / rho;
    double around[3] = {0.0, -face.outward[2], face.outward[1]};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            face.curvature[3 * i + j] = around[i] * around[j] / radius;
    return face;
}

int face_box(const double half[3], const double p[3], struct face *faces)
{
    for (int i = 0; i < 6; i++) {
        int axis = i / 2;
        int u = (axis + 1) % 3;
        int v = (axis + 2) % 3;
        faces[i] = face_plane(axis, i % 2 == 0 ? -1.0 : 1.0, half[axis], p);
        faces[i].beyond = fmax(fabs(p[u]) - half[u], fabs(p[v]) - half[v]);
    }
    return 6;
}
