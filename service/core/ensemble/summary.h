/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Statistics of a sample of numbers, and the shape of its distribution. NAN stands for a value that
 * is missing and is left out. */
#ifndef PERCUSS_ENSEMBLE_SUMMARY_H
#define PERCUSS_ENSEMBLE_SUMMARY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct moments {
    size_t count; /* of finite values */
    double mean;
    double deviation; /* standard, of the population: divided by count - 1 */
    double skewness;  /* adjusted Fisher-Pearson */
    double fourth;    /* central moment, divided by count */
    double lowest, highest;
};

/* Two passes in the order of the array, so that equal arrays give equal bits. NAN where there are
 * too few values (skewness needs three). Values that are equal but for rounding have no deviation,
 * and no skewness: NAN. */
struct moments summary_moments(const double *values, size_t count);

/* Whether the values differ by more than rounding. False for less than two. */
bool summary_varies(const struct moments *moments);

/* The finite values, ascending, in `sorted` (room for `count`; may be `values`), and how many they
 * are. False: out of memory. */
bool summary_sort(const double *values, size_t count, double *sorted, size_t *kept);

/* Quantile at probability p of ascending values, linear between them (Hyndman and Fan 1996, type
 * 7). NAN without values. */
double summary_quantile(const double *sorted, size_t count, double p);

/* The empirical distribution function: share of ascending values that are <= x. */
double summary_share(const double *sorted, size_t count, double x);

/* How many bins a histogram of so many values gets: their square root, 8 to 50. */
size_t summary_bins(size_t count);

/* Bins of equal width from the lowest to the highest value; edges[bins + 1], counts[bins]. A value
 * on an inner edge belongs to the bin above. */
void summary_histogram(const double *sorted, size_t count, size_t bins, double *edges,
                       uint64_t *counts);

/* Shape of a distribution of the restitution within its possible range. */

/* Where a quantity can lie; infinite: unbounded. */
struct shape_range {
    double low, high;
};

/* mean -+ sigmas x deviation as the paper draws it, and the interval between the quantiles that
 * enclose as much of the sample as a normal distribution has within it. */
struct sigma_interval {
    double sigmas;
    double low, high;
    double covered;    /* share of the sample inside */
    double unphysical; /* share of its length where no value can be */
    double quantile_low, quantile_high;
};
struct sigma_interval shape_sigma_interval(const double *sorted, const struct moments *moments,
                                           double sigmas, const struct shape_range *range);

/* A Beta distribution on a range of possible values, by its moments. */
struct beta_fit {
    double low, high;
    double alpha, beta; /* NAN: the moments are not those of any Beta distribution, or no range */
    double distance;    /* Kolmogorov-Smirnov, largest difference of the distribution functions */
    double p_value;     /* asymptotic; too large as the parameters were fitted, so that a small one
                           refuses the fit for certain */
};
struct beta_fit shape_fit_beta(const double *sorted, const struct moments *moments,
                               const struct shape_range *range);

/* P(D > d) of the Kolmogorov-Smirnov distance of n values from a given distribution, asymptotic
 * with Stephens's correction (1970). */
double shape_kolmogorov_p(double distance, double n);

#endif
