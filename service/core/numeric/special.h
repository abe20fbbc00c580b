/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Special functions: the distribution functions that statistics need, and elliptic integrals. */
#ifndef PERCUSS_NUMERIC_SPECIAL_H
#define PERCUSS_NUMERIC_SPECIAL_H

/* Standard normal: P(Z <= z), relative error some 1e-15 in both tails. */
double special_normal_cdf(double z);

/* Its inverse for 0 < p < 1; relative error below 1e-14 (Acklam's rational start, two Halley
 * steps). */
double special_normal_quantile(double p);

/* Regularised incomplete beta function I_x(a, b), a, b > 0, 0 <= x <= 1: the distribution function
 * of Beta(a, b). Continued fraction (DLMF 8.17.22) by Lentz's method; absolute error some 1e-14 up
 * to a + b = 1e4, growing with the logarithm of the factor in front. */
double special_beta_cdf(double a, double b, double x);

/* Student's t with n > 0 degrees of freedom: the t with P(T <= t) = p, 0 < p < 1. */
double special_student_quantile(double n, double p);

/* P(X <= k) of a binomial count of n trials of probability p. */
double special_binomial_cdf(double k, double n, double p);

/* Carlson's symmetric elliptic integrals, which have no cancellation near the circle: R_F(0, y, z)
 * for y, z > 0; K(m) = R_F(0, 1 - m, 1). */
double special_elliptic_rf0(double y, double z);

/* R_D(0, y, z) for y, z > 0: (K(m) - E(m)) / m = R_D(0, 1 - m, 1) / 3. */
double special_elliptic_rd0(double y, double z);

#endif
