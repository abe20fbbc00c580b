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

/* Eigenvalues of a symmetric matrix within (low, high], ascending, and their vectors, one after the
 * other; only the lower triangle, by columns, is read, and the matrix is lost. `vectors` and
 * `eigenvalues` have room for all. Their number; SIZE_MAX: none converged, or out of memory. */
size_t linear_eigen_between(size_t n, double *a, double low, double high, double *eigenvalues,
                            double *vectors);

/* Cholesky's factor of a positive definite matrix in its own place, the lower triangle packed by
 * columns, and the solution with it. False: it is not positive definite. */
bool linear_packed_factor(size_t n, double *a);
void linear_packed_solve(size_t n, const double *factor, double *x);

/* One thread at a time in BLAS and LAPACK: Debian's serial OpenBLAS gives all threads the same
 * buffers (its blas_memory_alloc has no lock), so that two threads that factor at once get wrong
 * numbers. Every call of either library stands between these two. */
void linear_turn_begin(void);
void linear_turn_end(void);

#endif
