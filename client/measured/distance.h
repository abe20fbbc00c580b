/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How different two samples of a number are, and how likely a difference as large is by chance if
 * both come from one distribution. */
#ifndef PERCUSS_MEASURED_DISTANCE_H
#define PERCUSS_MEASURED_DISTANCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct distance {
    double value;
    double p; /* of a distance at least as large */
};

/* Kolmogorov-Smirnov: the largest difference of the empirical distributions. The p-value is exact
 * for up to some thousand values each (counting lattice paths, Hodges 1957; with ties it is an
 * upper bound), else the asymptotic one. False: out of memory or an empty sample. */
bool distance_kolmogorov(const double *x, size_t nx, const double *y, size_t ny,
                         struct distance *distance);

/* Energy distance 2 E|X-Y| - E|X-X'| - E|Y-Y'| (Szekely and Rizzo 2004), which for numbers is twice
 * the integral of the squared difference of the distributions; p-value from so many random
 * permutations. False: out of memory or an empty sample. */
bool distance_energy(const double *x, size_t nx, const double *y, size_t ny, unsigned permutations,
                     uint64_t seed, struct distance *distance);

/* Mean, and standard deviation with n - 1; NAN where undefined. */
double sample_mean(const double *x, size_t n);
double sample_deviation(const double *x, size_t n);

/* The median; reorders x. NAN for none. */
double sample_median(double *x, size_t n);

/* Quantile of Student's distribution: P(T <= t) = p with `freedom` > 0 degrees of freedom. */
double student_quantile(double p, double freedom);

#endif
