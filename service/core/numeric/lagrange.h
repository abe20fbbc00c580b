/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lagrange's polynomials through places of a line that differ. */
#ifndef PERCUSS_NUMERIC_LAGRANGE_H
#define PERCUSS_NUMERIC_LAGRANGE_H

#include <stddef.h>

/* Their values at s, [count]; and their derivatives there. */
void lagrange_values(const double *place, size_t count, double s, double *value);
void lagrange_slopes(const double *place, size_t count, double s, double *slope);

#endif
