/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Orthogonal polynomials on a line and in a circle. */
#ifndef PERCUSS_MODEL_POLYNOMIAL_H
#define PERCUSS_MODEL_POLYNOMIAL_H

#include <stdbool.h>
#include <stddef.h>

/* Most of a circle along y or z. */
enum { POLYNOMIAL_MOST = 40 };

/* Legendre's, of mean square 1 over [-1, 1]. */
void polynomial_legendre(size_t count, double x, double *value);

/* Those that vanish at x = -1 (held[0]), at x = 1 (held[1]) or at both, of mean square 1 and
 * orthogonal over [-1, 1]: (1 - x)^a (1 + x)^b P_n, a and b being 1 where it is held and 0
 * elsewhere, P_n Jacobi's of (2 a, 2 b). With their derivatives unless that is NULL. */
void polynomial_held(size_t count, const bool held[2], double x, double *value, double *slope);

/* Zernike's of mean square 1 over the circle of radius 1, in the place of y^q z^r, q + r < count:
 * sqrt((2) (n + 1)) R_n^m(radius) cos(m angle) or sin, n = q + r; cosines where r is even, whose
 * parities are those of y^q z^r. R_n^m(s) = s^m P_k(2 s^2 - 1), P_k Jacobi's of (0, m), k = (n -
 * m)/2. With derivatives along y and z where these are not NULL; [q][r], POLYNOMIAL_MOST long. */
void polynomial_zernike(size_t count, double y, double z, double *value, double *along_y,
                        double *along_z);

/* Gauss' rule of n points on [0, 1], by Newton's method on Legendre's polynomial. */
void polynomial_gauss(size_t n, double *x, double *weight);

#endif
