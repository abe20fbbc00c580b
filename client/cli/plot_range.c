/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "plot.h"

void plot_range_take(struct plot_range *range, double value)
{
    if (!isfinite(value))
        return;
    bool first = range->low > range->high;
    range->low = first ? value : fmin(range->low, value);
    range->high = first ? value : fmax(range->high, value);
}

void plot_range_take_all(struct plot_range *range, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        plot_range_take(range, values[i]);
}

void plot_range_set(const struct plot *plot, const char *axis, const struct plot_range *range,
                    double margin)
{
    double low = range->low, high = range->high;
    /* of nothing, the unit; about one value, a tenth of it */
    if (low > high) {
        low = 0.0;
        high = 1.0;
    }
    double width = high > low ? high - low : fmax(0.1 * fabs(high), 1e-9);
    fprintf(plot->script, "set %s [%.9g:%.9g]\n", axis, low - margin * width,
            high + margin * width);
}
