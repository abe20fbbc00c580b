/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/linear.h"

#include <lapacke.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

/* A global, as the buffers that it guards are. */
static once_flag linear_lock_made = ONCE_FLAG_INIT;
static mtx_t linear_lock;

static void linear_lock_make(void)
{
    mtx_init(&linear_lock, mtx_plain);
}

void linear_turn_begin(void)
{
    call_once(&linear_lock_made, linear_lock_make);
    mtx_lock(&linear_lock);
}

void linear_turn_end(void)
{
    mtx_unlock(&linear_lock);
}

bool linear_symmetric_eigen(size_t n, double *a, double *eigenvalues)
{
    /* a symmetric matrix is its own transpose: column-major avoids LAPACKE's copies, and column i
     * of the result is row i of ours */
    lapack_int order = (lapack_int)n;
    linear_turn_begin();
    lapack_int result = LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'U', order, a, order, eigenvalues);
    linear_turn_end();
    return result == 0;
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

size_t linear_eigen_between(size_t n, double *a, double low, double high, double *eigenvalues,
                            double *vectors)
{
    lapack_int order = (lapack_int)n, found = 0, result = -1;
    lapack_int *support = calloc(2 * n + 1, sizeof *support);
    if (support) {
        linear_turn_begin();
        result = LAPACKE_dsyevr(LAPACK_COL_MAJOR, 'V', 'V', 'L', order, a, order, low, high, 0, 0,
                                0.0, &found, eigenvalues, vectors, order, support);
        linear_turn_end();
    }
    free(support);
    return result == 0 ? (size_t)found : SIZE_MAX;
}

bool linear_packed_factor(size_t n, double *a)
{
    linear_turn_begin();
    lapack_int result = LAPACKE_dpptrf(LAPACK_COL_MAJOR, 'L', (lapack_int)n, a);
    linear_turn_end();
    return result == 0;
}

void linear_packed_solve(size_t n, const double *factor, double *x)
{
    linear_turn_begin();
    LAPACKE_dpptrs(LAPACK_COL_MAJOR, 'L', (lapack_int)n, 1, factor, x, (lapack_int)n);
    linear_turn_end();
}
