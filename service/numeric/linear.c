/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/linear.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

static size_t pivot_row(size_t n, const double *a, size_t column)
{
    size_t best = column;
    for (size_t i = column + 1; i < n; i++)
        if (fabs(a[i * n + column]) > fabs(a[best * n + column]))
            best = i;
    return best;
}

static void swap_rows(size_t n, double *a, double *b, size_t i, size_t j)
{
    for (size_t k = 0; k < n; k++) {
        double t = a[i * n + k];
        a[i * n + k] = a[j * n + k];
        a[j * n + k] = t;
    }
    double t = b[i];
    b[i] = b[j];
    b[j] = t;
}

bool linear_solve(size_t n, double *a, double *b)
{
    for (size_t c = 0; c < n; c++) {
        size_t pivot = pivot_row(n, a, c);
        if (!(fabs(a[pivot * n + c]) > 0.0))
            return false;
        if (pivot != c)
            swap_rows(n, a, b, pivot, c);
        double inverse = 1.0 / a[c * n + c];
        for (size_t i = c + 1; i < n; i++) {
            double factor = a[i * n + c] * inverse;
            if (factor == 0.0)
                continue;
            for (size_t k = c + 1; k < n; k++)
                a[i * n + k] -= factor * a[c * n + k];
            b[i] -= factor * b[c];
        }
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    return true;
}

bool linear_symmetric_eigen(size_t n, double *a, double *eigenvalues)
{
    /* a symmetric matrix is its own transpose: column-major avoids LAPACKE's copies, and column i
     * of the result is row i of ours */
    lapack_int order = (lapack_int)n;
    return LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'U', order, a, order, eigenvalues) == 0;
}

double linear_pseudo_inverse(size_t n, const double *a, double relative, double *inverse,
                             double *scratch)
{
    double *vectors = scratch;
    double *values = scratch + n * n;
    memcpy(vectors, a, n * n * sizeof *a);
    if (!linear_symmetric_eigen(n, vectors, values))
        return NAN;
    double largest = values[n - 1];
    memset(inverse, 0, n * n * sizeof *inverse);
    for (size_t k = 0; k < n; k++) {
        if (!(values[k] > relative * largest))
            continue;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                inverse[i * n + j] += vectors[k * n + i] * vectors[k * n + j] / values[k];
    }
    return values[0] / largest;
}
