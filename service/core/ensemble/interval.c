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

/* Mean square difference from the mean of all. */
static double replicate_square(const struct interval_sample *sample, size_t replicate, double mean)
{
    double sum = 0.0;
    size_t kept = 0;
    for (size_t i = replicate; i < sample->count; i += sample->replicates) {
        if (!isfinite(sample->values[i]))
            continue;
        sum += (sample->values[i] - mean) * (sample->values[i] - mean);
        kept++;
    }
    return sum / (double)kept;
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
        each[r] = replicate_square(sample, r, moments->mean);
    return around(s, replicated_half_width(sample, each) / (2.0 * s));
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

/* Where the lower bound of the quantile at p lies among n ascending values: *share of the way from
 * value *rank (from 1) to the next. x_(r) is above the quantile with probability P(X < r), X the
 * count of values below it; the bound in between that is above with probability `miss` follows from
 * gaps that are exponential on either side. 0: so few values have none. */
static size_t lower_bound(size_t n, double p, double miss, double *share)
{
    size_t rank = binomial_quantile(n, p, miss);
    if (rank == 0 || rank >= n)
        return 0;
    double r = (double)rank, rest = (double)n - r;
    double before = special_binomial_cdf(r - 1.0, (double)n, p);
    double after = special_binomial_cdf(r, (double)n, p);
    *share = 1.0 / (1.0 + r * (1.0 - p) * (after - miss) / (rest * p * (miss - before)));
    return rank;
}

static struct interval plain_quantile(const struct interval_sample *sample, double p)
{
    const double *x = sample->sorted;
    size_t n = sample->kept;
    double miss = 0.5 * (1.0 - sample->level), share;
    struct interval interval = unknown;
    size_t rank = lower_bound(n, p, miss, &share);
    if (rank)
        interval.low = x[rank - 1] + share * (x[rank] - x[rank - 1]);
    rank = lower_bound(n, 1.0 - p, miss, &share);
    if (rank)
        interval.high = x[n - rank] - share * (x[n - rank] - x[n - rank - 1]);
    return interval;
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
    /* half-way to the next value the share is the same */
    double h = replicated_half_width(sample, each) + 0.5 / (double)sample->kept;
    return (struct interval){
        p - h > 0.0 ? summary_quantile(sample->sorted, sample->kept, p - h) : NAN,
        p + h < 1.0 ? summary_quantile(sample->sorted, sample->kept, p + h) : NAN,
    };
}

struct interval interval_share(size_t hits, size_t count, double level)
{
    if (count == 0)
        return unknown;
    double n = (double)count, share = (double)hits / n;
    double z = special_normal_quantile(0.5 + 0.5 * level), more = z * z / n;
    double middle = (share + 0.5 * more) / (1.0 + more);
    double half = z / (1.0 + more) * sqrt(share * (1.0 - share) / n + 0.25 * more / n);
    return (struct interval){fmax(0.0, middle - half), fmin(1.0, middle + half)};
}
