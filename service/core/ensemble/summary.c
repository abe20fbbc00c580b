/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/summary.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Values that differ by less, relative to their size, differ by rounding: some thousand steps of
 * it, far below the 1e-9 to which an impact is computed at its best. */
static const double ROUNDING = 1e-12;

bool summary_varies(const struct moments *moments)
{
    double size = fmax(fabs(moments->lowest), fabs(moments->highest));
    return moments->count > 1 && moments->highest - moments->lowest > ROUNDING * size;
}

static void find_range(const double *values, size_t count, struct moments *moments)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i]))
            continue;
        sum += values[i];
        moments->lowest = fmin(moments->lowest, values[i]);
        moments->highest = fmax(moments->highest, values[i]);
        moments->count++;
    }
    moments->mean = sum / (double)moments->count;
}

struct moments summary_moments(const double *values, size_t count)
{
    struct moments moments = {.lowest = NAN, .highest = NAN, .deviation = NAN, .skewness = NAN};
    /* first pass: range and mean */
    find_range(values, count, &moments);
    if (moments.count > 1 && !summary_varies(&moments)) {
        /* the mean of equal values is that value, in spite of rounding in the sum */
        moments.mean = fmax(moments.lowest, fmin(moments.mean, moments.highest));
        moments.deviation = moments.fourth = 0.0;
        return moments;
    }
    /* second pass: sums of powers about the mean */
    double rest = 0.0, second = 0.0, third = 0.0, fourth = 0.0;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i]))
            continue;
        double d = values[i] - moments.mean;
        rest += d;
        second += d * d;
        third += d * d * d;
        fourth += d * d * d * d;
    }
    double n = (double)moments.count;
    /* the rounding error of the mean */
    moments.mean += rest / n;
    moments.fourth = fourth / n;
    if (moments.count > 1)
        moments.deviation = sqrt(second / (n - 1.0));
    if (moments.count > 2 && second > 0.0)
        moments.skewness = sqrt(n * (n - 1.0)) / (n - 2.0) * (third / n) / pow(second / n, 1.5);
    return moments;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

size_t summary_sort(const double *values, size_t count, double *sorted)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            sorted[kept++] = values[i];
    qsort(sorted, kept, sizeof *sorted, compare);
    return kept;
}

double summary_quantile(const double *sorted, size_t count, double p)
{
    if (count == 0)
        return NAN;
    double place = p * (double)(count - 1);
    size_t below = (size_t)place;
    if (below + 1 >= count)
        return sorted[count - 1];
    return sorted[below] + (place - (double)below) * (sorted[below + 1] - sorted[below]);
}

/* Number of ascending values that are <= x. */
static size_t count_up_to(const double *sorted, size_t count, double x)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (sorted[middle] <= x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

double summary_share(const double *sorted, size_t count, double x)
{
    return (double)count_up_to(sorted, count, x) / (double)count;
}

size_t summary_bins(size_t count)
{
    double bins = ceil(sqrt((double)count));
    return (size_t)fmax(8.0, fmin(bins, 50.0));
}

void summary_histogram(const double *sorted, size_t count, size_t bins, double *edges,
                       uint64_t *counts)
{
    memset(counts, 0, bins * sizeof *counts);
    if (count == 0)
        return;
    double low = sorted[0], width = (sorted[count - 1] - low) / (double)bins;
    for (size_t b = 0; b < bins; b++)
        edges[b] = low + width * (double)b;
    edges[bins] = sorted[count - 1];
    size_t bin = 0;
    for (size_t i = 0; i < count; i++) {
        while (bin + 1 < bins && sorted[i] >= edges[bin + 1])
            bin++;
        counts[bin]++;
    }
}
