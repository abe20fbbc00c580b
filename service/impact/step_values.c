/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_values.h"

#include <math.h>

double step_values_closing(const struct step_values *values)
{
    double before = values->start;
    double at = 0.0;
    for (int j = 0; j <= NODES; j++) {
        double s = j < NODES ? collocation.node[j] : 1.0;
        double d = j < NODES ? values->nodes[j] : values->end;
        double missing = before < 0.0 ? -before : 0.0;
        if (d > 0.0)
            return at + (s - at) * missing / (d + missing);
        before = d;
        at = s;
    }
    return 1.0;
}

double step_values_release(const struct step_values *values)
{
    double after = values->end;
    double at = 1.0;
    for (int j = NODES - 1; j >= -1; j--) {
        double s = j < 0 ? 0.0 : collocation.node[j];
        double d = j < 0 ? values->start : values->nodes[j];
        if (d > 0.0)
            return s + (at - s) * d / (d - after);
        after = d;
        at = s;
    }
    return 0.0;
}

struct contact_start step_values_after(const struct step_values *values, double h)
{
    const double *d = values->nodes;
    double r = 1.0 / h;
    double slope[NODES];
    for (int m = 1; m < NODES; m++) {
        const double *by = collocation.end[m];
        slope[m] = (by[0] * d[0] + by[1] * d[1]) + (by[2] * d[2] + by[3] * d[3]);
    }
    return (struct contact_start){values->end, slope[1] * r, 2.0 * slope[2] * (r * r),
                                  6.0 * slope[3] * (r * r * r)};
}

double step_values_opens(const struct contact_start *now)
{
    double square = now->rate * now->rate - 2.0 * now->curvature * now->indentation;
    double fall = square >= 0.0 ? sqrt(square) - now->rate : 0.0;
    return fall > 0.0 && now->indentation > 0.0 ? 2.0 * now->indentation / fall : INFINITY;
}
