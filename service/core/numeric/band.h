/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Symmetric positive definite band matrices (LAPACK dpbtrf). */
#ifndef PERCUSS_NUMERIC_BAND_H
#define PERCUSS_NUMERIC_BAND_H

#include <stdbool.h>
#include <stddef.h>

/* The lower triangle of an n x n matrix with `width` diagonals below the main one, column by
 * column: entry (i, j), j <= i <= j + width, at values[j * (width + 1) + i - j]. A factor L (matrix
 * = L L^T) is stored alike. The values belong to the caller. */
struct band {
    size_t n, width;
    double *values;
};

static inline double *band_entry(const struct band *band, size_t i, size_t j)
{
    return &band->values[j * (band->width + 1) + i - j];
}

/* The matrix becomes its factor. False: not positive definite. */
bool band_factor(struct band *band);

/* Columns `first` to n - 1 of `band`, which hold the matrix, become those of its factor; the
 * columns before `first` are taken from `leading`, the factor of a matrix with the same leading
 * columns. False: not positive definite. */
bool band_factor_trailing(struct band *band, const struct band *leading, size_t first);

/* Solves L y = b (forward) or L^T y = b (backward) in place. Rows and columns from `first` to
 * `end` - 1 alone take part; b is indexed from row 0. */
void band_forward(const struct band *factor, size_t first, size_t end, double *b);
void band_backward(const struct band *factor, size_t first, size_t end, double *b);

/* Subtracts the contribution of rows before `first`, with the solution y, from rows `first` and
 * beyond: b -= L_21 y. y and b are indexed from row 0. */
void band_carry_forward(const struct band *factor, size_t first, const double *y, double *b);

/* The same for the backward solve: subtracts the contribution of rows `first` and beyond from the
 * rows before. */
void band_carry_backward(const struct band *factor, size_t first, const double *y, double *b);

#endif
