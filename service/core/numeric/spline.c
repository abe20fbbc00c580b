/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/spline.h"

#include <math.h>

size_t spline_segment(const struct spline *spline, double x)
{
    size_t low = 0;
    size_t high = spline->count - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (spline->place[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double spline_on(const struct spline *spline, size_t i, double x, double *slope)
{
    double h = spline->place[i + 1] - spline->place[i];
    double t = (x - spline->place[i]) / h;
    return spline_between(h, t, spline->value + i, spline->slope + i, slope);
}

double spline_near(const struct spline *spline, size_t *segment, double x, double *slope)
{
    size_t last = spline->count - 1;
    const double *place = spline->place;
    if (!(x < place[last])) {
        *slope = spline->slope[last];
        return spline->value[last] + *slope * (x - place[last]);
    }
    if (!(place[*segment] <= x && x < place[*segment + 1]))
        *segment = spline_segment(spline, x);
    return spline_on(spline, *segment, x, slope);
}

double spline_at(const struct spline *spline, double x, double *slope)
{
    size_t segment = 0;
    return spline_near(spline, &segment, x, slope);
}

/* Slope at an end of the polynomial through the four points from it inward (three, if there are no
 * more), by Lagrange's formula. */
static double end_slope(const struct spline *spline, size_t end, int inward)
{
    size_t count = spline->count < 4 ? spline->count : 4;
    const double *x = spline->place + end;
    const double *y = spline->value + end;
    double slope = 0.0;
    for (size_t i = 1; i < count; i++) {
        double xi = x[inward * (int)i];
        double weight = 1.0 / (xi - x[0]);
        for (size_t j = 1; j < count; j++)
            if (j != i)
                weight *= (x[0] - x[inward * (int)j]) / (xi - x[inward * (int)j]);
        slope += weight * (y[inward * (int)i] - y[0]);
    }
    return slope;
}

void spline_set_slopes(struct spline *spline, double *scratch)
{
    size_t n = spline->count;
    double *s = spline->slope;
    double *upper = scratch;
    double *chord = scratch + n;
    for (size_t i = 0; i + 1 < n; i++)
        chord[i] =
            (spline->value[i + 1] - spline->value[i]) / (spline->place[i + 1] - spline->place[i]);
    s[0] = chord[0];
    s[n - 1] = chord[n - 2];
    if (n > 2) {
        s[0] = end_slope(spline, 0, 1);
        s[n - 1] = end_slope(spline, n - 1, -1);
    }
    /* tridiagonal: h1 s[i-1] + 2 (h0 + h1) s[i] + h0 s[i+1] = 3 (h1 chord[i-1] + h0 chord[i]) */
    upper[0] = 0.0;
    for (size_t i = 1; i + 1 < n; i++) {
        double h0 = spline->place[i] - spline->place[i - 1];
        double h1 = spline->place[i + 1] - spline->place[i];
        double pivot = 2.0 * (h0 + h1) - h1 * upper[i - 1];
        upper[i] = h0 / pivot;
        s[i] = (3.0 * (h1 * chord[i - 1] + h0 * chord[i]) - h1 * s[i - 1]) / pivot;
    }
    for (size_t i = n - 1; i-- > 1;)
        s[i] -= upper[i] * s[i + 1];
    /* within the square of Fritsch and Carlson: monotone */
    for (size_t i = 0; i < n; i++) {
        double least =
            fmin(i > 0 ? fabs(chord[i - 1]) : INFINITY, i + 1 < n ? fabs(chord[i]) : INFINITY);
        double sign = chord[i > 0 ? i - 1 : 0] < 0.0 ? -1.0 : 1.0;
        s[i] = sign * fmin(fmax(sign * s[i], 0.0), 3.0 * least);
    }
}
