/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Monotone cubic splines. */
#ifndef PERCUSS_NUMERIC_SPLINE_H
#define PERCUSS_NUMERIC_SPLINE_H

#include <stddef.h>

/* Values and slopes at ascending places, all of length count >= 2; the arrays are the owner's. */
struct spline {
    size_t count;
    double *place, *value, *slope;
};

/* Slopes for monotone values: those of the spline with a continuous second derivative and the
 * end slopes of cubics, limited where it would not be monotone between two places (Fritsch
 * and Carlson, SIAM J. Numer. Anal. 17 (1980) 238). `scratch` holds 2 count. */
void spline_set_slopes(struct spline *spline, double *scratch);

/* Index i with place[i] <= x < place[i + 1], clamped to the segments. */
size_t spline_segment(const struct spline *spline, double x);

/* Between two places h apart, at the share t of the way: the cubic of the values and slopes there;
 * *slope becomes its derivative. */
static inline double spline_between(double h, double t, const double value[2],
                                    const double slopes[2], double *slope)
{
    double rise = value[1] - value[0];
    double left = h * slopes[0];
    double right = h * slopes[1];
    double square = 3.0 * rise - 2.0 * left - right;
    double cube = left + right - 2.0 * rise;
    *slope = (left + t * (2.0 * square + 3.0 * t * cube)) / h;
    return value[0] + t * (left + t * (square + t * cube));
}

/* Third derivative on segment i. */
static inline double spline_third(const struct spline *spline, size_t i)
{
    double h = spline->place[i + 1] - spline->place[i];
    double chord = (spline->value[i + 1] - spline->value[i]) / h;
    return 6.0 * (spline->slope[i] + spline->slope[i + 1] - 2.0 * chord) / (h * h);
}

/* Value on segment i; *slope becomes its derivative. */
double spline_on(const struct spline *spline, size_t i, double x, double *slope);

/* Value anywhere from the first place on; linear beyond the last one. */
double spline_at(const struct spline *spline, double x, double *slope);
/* The same; tries *segment first, which becomes that of x. */
double spline_near(const struct spline *spline, size_t *segment, double x, double *slope);

#endif
