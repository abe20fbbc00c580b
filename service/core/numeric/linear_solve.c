/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Apart from the rest of linear.c, which needs LAPACK: lcp.c with this file alone is also part of
 * the client's slow scale. */
#include "numeric/linear.h"

#include <math.h>

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
        /* the largest entry left in the column to the diagonal */
        size_t pivot = pivot_row(n, a, c);
        if (!(fabs(a[pivot * n + c]) > 0.0))
            return false;
        if (pivot != c)
            swap_rows(n, a, b, pivot, c);
        /* off the rows below */
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
    /* back substitution */
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    return true;
}
