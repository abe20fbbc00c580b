/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/dense.h"

#include <cblas.h>

#include "numeric/linear.h"

void dense_products(struct dense a, struct dense b, double *products)
{
    if (a.count == 0 || b.count == 0)
        return;
    linear_turn_begin();
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, (int)a.count, (int)b.count, (int)a.n, 1.0,
                a.values, (int)a.n, b.values, (int)b.n, 0.0, products, (int)a.count);
    linear_turn_end();
}

void dense_combine(struct dense a, double factor, const double *coefficients, double keep,
                   size_t y_count, double *y)
{
    if (a.count == 0 || y_count == 0)
        return;
    linear_turn_begin();
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, (int)a.n, (int)y_count, (int)a.count,
                factor, a.values, (int)a.n, coefficients, (int)a.count, keep, y, (int)a.n);
    linear_turn_end();
}
