/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Small dense linear algebra of the solver. */
#ifndef PERCUSS_NUMERIC_LINEAR_H
#define PERCUSS_NUMERIC_LINEAR_H

#include <stdbool.h>
#include <stddef.h>

/* Solves a x = b in place by elimination with partial pivoting: a is n x n row-major and destroyed,
 * b of length n becomes x. False: singular. Fixed order of operations: same input, same bits. */
bool linear_solve(size_t n, double *a, double *b);

/* Eigenvalues (ascending, n) of the symmetric n x n row-major matrix `a`, which becomes the
 * orthonormal eigenvectors, eigenvector i in row i (LAPACK dsyev). False: no convergence. */
bool linear_symmetric_eigen(size_t n, double *a, double *eigenvalues);

/* Moore-Penrose inverse of a symmetric positive semidefinite matrix, eigenvalues below `relative`
 * times the largest counting as zero. `scratch` holds n * (n + 1). Returns the smallest eigenvalue
 * over the largest (negative: not semidefinite), NAN on failure. */
double linear_pseudo_inverse(size_t n, const double *a, double relative, double *inverse,
                             double *scratch);

#endif
