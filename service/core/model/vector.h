/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Vectors of three, rotations by unit quaternions (w, x, y, z). */
#ifndef PERCUSS_MODEL_VECTOR_H
#define PERCUSS_MODEL_VECTOR_H

#include <math.h>

static inline double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double norm3(const double a[3])
{
    return sqrt(dot3(a, a));
}

static inline void cross3(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void sub3(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[i] - b[i];
}

static inline void scale3(double s, const double a[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = s * a[i];
}

/* y += s a */
static inline void add_scaled3(double s, const double a[3], double y[3])
{
    for (int i = 0; i < 3; i++)
        y[i] += s * a[i];
}

/* Rotation matrix (row-major) of a unit quaternion: world = r body. */
static inline void rotation_matrix(const double q[4], double r[9])
{
    double w = q[0], x = q[1], y = q[2], z = q[3];
    r[0] = 1.0 - 2.0 * (y * y + z * z);
    r[1] = 2.0 * (x * y - w * z);
    r[2] = 2.0 * (x * z + w * y);
    r[3] = 2.0 * (x * y + w * z);
    r[4] = 1.0 - 2.0 * (x * x + z * z);
    r[5] = 2.0 * (y * z - w * x);
    r[6] = 2.0 * (x * z - w * y);
    r[7] = 2.0 * (y * z + w * x);
    r[8] = 1.0 - 2.0 * (x * x + y * y);
}

static inline void rotate3(const double r[9], const double a[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = r[3 * i] * a[0] + r[3 * i + 1] * a[1] + r[3 * i + 2] * a[2];
}

static inline void rotate_back3(const double r[9], const double a[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = r[i] * a[0] + r[i + 3] * a[1] + r[i + 6] * a[2];
}

#endif
