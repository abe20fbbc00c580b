/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/shape.h"

#include <math.h>

#include "numeric/special.h"

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

static double distance_from_beta(const double *sorted, size_t n, const struct beta_fit *fit)
{
    double worst = 0.0;
    for (size_t i = 0; i < n; i++) {
        double x = (sorted[i] - fit->low) / (fit->high - fit->low);
        double f = special_beta_cdf(fit->alpha, fit->beta, x);
        worst = fmax(worst, fmax(f - (double)i / (double)n, (double)(i + 1) / (double)n - f));
    }
    return worst;
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
