/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The larger and the smaller of two numbers, b where one is NAN: comparisons, where fmax and fmin
 * are calls. */
#ifndef PERCUSS_BASE_EXTREMES_H
#define PERCUSS_BASE_EXTREMES_H

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

#endif
