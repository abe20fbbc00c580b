/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/rational.h"

#include <math.h>
#include <stdbool.h>

/* The stages Y = u0 1 + h A (dY/dt), A = T diag(pole, its conjugate) T^-1, become p = the first of
 * T^-1 Y, with T scaled so that the first of T^-1 1 is 1; u1 = u0 (1 - d 1) + d Y with d = b A^-1.
 */
struct rational rational_make(enum rational_rule rule)
{
    /* the method's places, matrix and weights */
    double w = sqrt(3.0) / 6.0;
    bool radau = rule == RATIONAL_RADAU;
    double place[2] = {radau ? 1.0 / 3.0 : 0.5 - w, radau ? 1.0 : 0.5 + w};
    double a[2][2] = {{radau ? 5.0 / 12.0 : 0.25, radau ? -1.0 / 12.0 : 0.25 - w},
                      {radau ? 0.75 : 0.25 + w, 0.25}};
    double b[2] = {radau ? 0.75 : 0.5, radau ? 0.25 : 0.5};
    /* the eigenvalue and its vector t; the other column of T is conjugate */
    double half_trace = 0.5 * (a[0][0] + a[1][1]);
    double determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    double complex pole = half_trace + I * sqrt(determinant - half_trace * half_trace);
    double complex t[2] = {a[0][1], pole - a[0][0]};
    double complex over = t[0] * conj(t[1]) - conj(t[0]) * t[1];
    double complex inverse[2] = {conj(t[1]) / over, -conj(t[0]) / over};
    double complex scale = inverse[0] + inverse[1];
    /* d = b A^-1 */
    double d[2] = {(b[0] * a[1][1] - b[1] * a[1][0]) / determinant,
                   (b[1] * a[0][0] - b[0] * a[0][1]) / determinant};
    struct rational made = {.pole = pole, .keep = 1.0 - d[0] - d[1]};
    made.weight = scale * (d[0] * t[0] + d[1] * t[1]);
    for (int i = 0; i < 2; i++) {
        made.start += inverse[i] / scale * (1.0 - place[i]);
        made.end += inverse[i] / scale * place[i];
    }
    return made;
}
