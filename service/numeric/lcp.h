/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Linear complementarity: 0 <= z, 0 <= m z + q, z^T (m z + q) = 0. */
#ifndef PERCUSS_NUMERIC_LCP_H
#define PERCUSS_NUMERIC_LCP_H

#include <stdbool.h>
#include <stddef.h>

/* Lemke's method with the lexicographic ratio test for an n x n row-major symmetric positive
 * semidefinite m; its diagonal is raised by 1e-10 of itself so that singular matrices are safe. z
 * receives the solution. False: no solution (or its residual exceeds 1e-8 of max |q|), or memory.
 */
bool lcp_solve(size_t n, const double *m, const double *q, double *z);

#endif
