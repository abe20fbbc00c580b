/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Statistics of a sample of numbers. NAN stands for a value that is missing and is left out. */
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

/* The finite values, ascending, in `sorted` (room for `count`). Returns how many they are. */
size_t summary_sort(const double *values, size_t count, double *sorted);

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

#endif
