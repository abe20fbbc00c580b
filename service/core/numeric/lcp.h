/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Linear complementarity: 0 <= z, 0 <= m z + q, z^T (m z + q) = 0. */
#ifndef PERCUSS_NUMERIC_LCP_H
#define PERCUSS_NUMERIC_LCP_H

#include <stddef.h>

/* Lemke's method with the lexicographic ratio test for an n x n row-major symmetric positive
 * semidefinite m; its diagonal is raised by 1e-10 of itself so that singular matrices are safe. z
 * receives the solution, or with LCP_UNSOLVED an approximation with a residual above 1e-8 of max
 * |q|. */
enum lcp_outcome { LCP_SOLVED, LCP_UNSOLVED, LCP_NO_MEMORY };
enum lcp_outcome lcp_solve(size_t n, const double *m, const double *q, double *z);

#endif
