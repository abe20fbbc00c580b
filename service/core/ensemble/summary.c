/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/summary.h"

#include <math.h>
#include <string.h>

#include "numeric/sorting.h"
#include "numeric/special.h"

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

bool summary_sort(const double *values, size_t count, double *sorted, size_t *kept)
{
    *kept = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            sorted[(*kept)++] = values[i];
    return sorting_ascend(sorted, NULL, *kept);
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

/* ---- shape of a distribution ---- */

/* Length of the part of [low, high] outside the range. */
static double length_outside(double low, double high, const struct shape_range *range)
{
    double below = fmax(0.0, fmin(high, range->low) - low);
    double above = fmax(0.0, high - fmax(low, range->high));
    return below + above;
}

struct sigma_interval shape_sigma_interval(const double *sorted, const struct moments *moments,
                                           double sigmas, const struct shape_range *range)
{
    size_t n = moments->count;
    /* the interval, and the quantiles of as large a share of a normal distribution */
    double half = sigmas * moments->deviation;
    double inside = 2.0 * special_normal_cdf(sigmas) - 1.0;
    struct sigma_interval interval = {
        .sigmas = sigmas,
        .low = moments->mean - half,
        .high = moments->mean + half,
        .quantile_low = summary_quantile(sorted, n, 0.5 - 0.5 * inside),
        .quantile_high = summary_quantile(sorted, n, 0.5 + 0.5 * inside),
    };
    /* share of the sample in it, its ends included */
    interval.covered = summary_share(sorted, n, interval.high) -
                       summary_share(sorted, n, nextafter(interval.low, -INFINITY));
    if (half == 0.0) /* all lie there, but for rounding */
        interval.covered = 1.0;
    /* and the impossible part of its length */
    interval.unphysical =
        half > 0.0 ? length_outside(interval.low, interval.high, range) / (2.0 * half) : 0.0;
    return interval;
}

double shape_kolmogorov_p(double distance, double n)
{
    double root = sqrt(n);
    double x = (root + 0.12 + 0.11 / root) * distance;
    double sum = 0.0;
    for (int k = 1; k <= 100; k++) {
        double term = exp(-2.0 * k * k * x * x);
        sum += k % 2 ? term : -term;
        if (term < 1e-17)
            break;
    }
    return x < 0.2 ? 1.0 : fmax(0.0, fmin(2.0 * sum, 1.0)); /* below 0.2 it is 1 to 1e-12 */
}

/* Ascending values beside a fitted distribution. */
struct beside {
    const double *sorted;
    double n;
    const struct beta_fit *fit;
};

/* A value by its index, and the fitted distribution function there. */
struct fitted {
    size_t index;
    double f;
};

static struct fitted fitted_at(const struct beside *beside, size_t index)
{
    const struct beta_fit *fit = beside->fit;
    double x = (beside->sorted[index] - fit->low) / (fit->high - fit->low);
    return (struct fitted){index, special_beta_cdf(fit->alpha, fit->beta, x)};
}

/* The largest distance that values from `first` to `last` may have, as both functions ascend; of
 * one value that which it has. */
static double distance_bound(const struct beside *beside, struct fitted first, struct fitted last)
{
    return fmax(last.f - (double)first.index / beside->n,
                (double)(last.index + 1) / beside->n - first.f);
}

/* The largest distance of the values between, or `worst` if that is larger. Where the bound says so
 * none of them is looked at. */
static double distance_between(const struct beside *beside, struct fitted first, struct fitted last,
                               double worst)
{
    if (last.index - first.index < 2 || distance_bound(beside, first, last) <= worst)
        return worst;
    struct fitted middle = fitted_at(beside, first.index + (last.index - first.index) / 2);
    worst = fmax(worst, distance_bound(beside, middle, middle));
    worst = distance_between(beside, first, middle, worst);
    return distance_between(beside, middle, last, worst);
}

static double distance_from_beta(const double *sorted, size_t n, const struct beta_fit *fit)
{
    const struct beside beside = {sorted, (double)n, fit};
    struct fitted first = fitted_at(&beside, 0), last = fitted_at(&beside, n - 1);
    double ends = fmax(distance_bound(&beside, first, first), distance_bound(&beside, last, last));
    return distance_between(&beside, first, last, ends);
}

struct beta_fit shape_fit_beta(const double *sorted, const struct moments *moments,
                               const struct shape_range *range)
{
    struct beta_fit fit = {range->low, range->high, NAN, NAN, NAN, NAN};
    double width = range->high - range->low;
    double mean = (moments->mean - range->low) / width;
    double variance = moments->deviation * moments->deviation / (width * width);
    double concentration = mean * (1.0 - mean) / variance - 1.0;
    bool within =
        moments->count > 1 && moments->lowest >= range->low && moments->highest <= range->high;
    if (!isfinite(width) || !within || !(concentration > 0.0) || !isfinite(concentration))
        return fit;
    fit.alpha = mean * concentration;
    fit.beta = (1.0 - mean) * concentration;
    fit.distance = distance_from_beta(sorted, moments->count, &fit);
    fit.p_value = shape_kolmogorov_p(fit.distance, (double)moments->count);
    return fit;
}
