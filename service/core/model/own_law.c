/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/own_law.h"

#include <math.h>
#include <stdlib.h>

bool own_curve_spline(const struct own_curve *curve, double **block, struct spline *spline)
{
    size_t n = curve->count;
    *block = malloc(4 * n * sizeof **block);
    if (!*block)
        return false;
    *spline = (struct spline){n, curve->indentation, *block, *block + n};
    for (size_t i = 0; i < n; i++)
        spline->value[i] = cbrt(curve->force[i] * curve->force[i]);
    spline_set_slopes(spline, *block + 2 * n);
    return true;
}

double own_curve_force(const struct spline *spline, double indentation)
{
    double slope, value = spline_at(spline, indentation, &slope);
    return value * sqrt(value);
}

void own_law_clear(struct own_law *law)
{
    free(law->points.indentation);
    free(law->unloading.indentation);
    law->points = law->unloading = (struct own_curve){0};
}
