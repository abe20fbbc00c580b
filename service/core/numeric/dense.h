/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Products of many long vectors (BLAS). Sets of vectors are stored one vector after the other; a
 * matrix of coefficients by columns. */
#ifndef PERCUSS_NUMERIC_DENSE_H
#define PERCUSS_NUMERIC_DENSE_H

#include <stddef.h>

/* Vectors of one length. */
struct dense {
    size_t n, count;
    const double *values; /* [count][n] */
};

/* products[j * a.count + i] = a_i . b_j */
void dense_products(struct dense a, struct dense b, double *products);

/* y_j = keep y_j + factor sum over i of a_i coefficients[j * a.count + i], j < y_count. */
void dense_combine(struct dense a, double factor, const double *coefficients, double keep,
                   size_t y_count, double *y);

#endif
