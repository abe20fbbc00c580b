/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/interval.h"

#include <math.h>

#include "ensemble/sampling.h"
#include "numeric/special.h"

static const struct interval unknown = {NAN, NAN};

/* t of the two-sided level with so many degrees of freedom. */
static double student(const struct interval_sample *sample, double degrees)
{
    return special_student_quantile(degrees, 0.5 + 0.5 * sample->level);
}

/* Half-width of the interval for the mean of one number a replicate. */
static double replicated_half_width(const struct interval_sample *sample, const double *each)
{
    struct moments moments = summary_moments(each, sample->replicates);
    if (moments.count != sample->replicates)
        return NAN;
    double n = (double)moments.count;
    return student(sample, n - 1.0) * moments.deviation / sqrt(n);
}

/* The values of one replicate, one by one: sums of what `f` makes of them. */
static double replicate_mean(const struct interval_sample *sample, size_t replicate)
{
    double sum = 0.0;
    size_t kept = 0;
    for (size_t i = replicate; i < sample->count; i += sample->replicates) {
        if (!isfinite(sample->values[i]))
            continue;
        sum += sample->values[i];
        kept++;
    }
    return sum / (double)kept;
}

static double replicate_deviation(const struct interval_sample *sample, size_t replicate)
{
    double mean = replicate_mean(sample, replicate), sum = 0.0;
    size_t kept = 0;
    for (size_t i = replicate; i < sample->count; i += sample->replicates) {
        if (!isfinite(sample->values[i]))
            continue;
        sum += (sample->values[i] - mean) * (sample->values[i] - mean);
        kept++;
    }
    return sqrt(sum / ((double)kept - 1.0));
}

static double replicate_share(const struct interval_sample *sample, size_t replicate, double x)
{
    size_t below = 0, kept = 0;
    for (size_t i = replicate; i < sample->count; i += sample->replicates) {
        below += sample->values[i] <= x;
        kept += isfinite(sample->values[i]);
    }
    return (double)below / (double)kept;
}

static struct interval around(double middle, double half_width)
{
    return (struct interval){middle - half_width, middle + half_width};
}

struct interval interval_mean(const struct interval_sample *sample, const struct moments *moments)
{
    if (moments->count < 2)
        return unknown;
    double n = (double)moments->count;
    if (sample->replicates == 1)
        return around(moments->mean, student(sample, n - 1.0) * moments->deviation / sqrt(n));
    double each[SAMPLING_REPLICATES];
    for (size_t r = 0; r < sample->replicates; r++)
        each[r] = replicate_mean(sample, r);
    return around(moments->mean, replicated_half_width(sample, each));
}

struct interval interval_deviation(const struct interval_sample *sample,
                                   const struct moments *moments)
{
    if (moments->count < 2 || !(moments->deviation > 0.0))
        return unknown;
    double n = (double)moments->count;
    double s = moments->deviation;
    if (sample->replicates == 1) {
        /* Var(s^2) = (mu_4 - sigma^4)/n for large n, and s = sqrt(s^2) */
        double error = sqrt(fmax(0.0, moments->fourth - s * s * s * s) / n) / (2.0 * s);
        return around(s, student(sample, n - 1.0) * error);
    }
    double each[SAMPLING_REPLICATES];
    for (size_t r = 0; r < sample->replicates; r++)
        each[r] = replicate_deviation(sample, r);
    return around(s, replicated_half_width(sample, each));
}

/* The smallest k with P(X <= k) >= `target` for a binomial count of n trials. */
static size_t binomial_quantile(size_t n, double p, double target)
{
    size_t low = 0, high = n;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (special_binomial_cdf((double)middle, (double)n, p) >= target)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* x_(l) is above the quantile if fewer than l values are below it, x_(u) below it if at least u
 * are: each may happen with half of what the level leaves. */
static struct interval plain_quantile(const struct interval_sample *sample, double p)
{
    double each_side = 0.5 * (1.0 - sample->level);
    size_t n = sample->kept;
    size_t low = binomial_quantile(n, p, each_side); /* x_(low): P(count < low) < half */
    size_t high = binomial_quantile(n, p, 1.0 - each_side) + 1;
    return (struct interval){
        low >= 1 ? sample->sorted[low - 1] : NAN,
        high <= n ? sample->sorted[high - 1] : NAN,
    };
}

struct interval interval_quantile(const struct interval_sample *sample, double p)
{
    if (sample->kept == 0)
        return unknown;
    if (sample->replicates == 1)
        return plain_quantile(sample, p);
    double x = summary_quantile(sample->sorted, sample->kept, p);
    double each[SAMPLING_REPLICATES];
    for (size_t r = 0; r < sample->replicates; r++)
        each[r] = replicate_share(sample, r, x);
    /* between two values the share is not known */
    double h = replicated_half_width(sample, each) + 1.0 / (double)sample->kept;
    return (struct interval){
        p - h > 0.0 ? summary_quantile(sample->sorted, sample->kept, p - h) : NAN,
        p + h < 1.0 ? summary_quantile(sample->sorted, sample->kept, p + h) : NAN,
    };
}
