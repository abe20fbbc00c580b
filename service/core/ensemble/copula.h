/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Correlated inputs by a Gaussian copula: the coefficients are those of the normal scores, whatever
 * the distributions are. */
#ifndef PERCUSS_ENSEMBLE_COPULA_H
#define PERCUSS_ENSEMBLE_COPULA_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"

struct copula_pair {
    size_t first, second; /* dimensions */
    double coefficient;   /* -1 .. 1 */
};

struct copula {
    size_t dimensions;
    double *factor; /* Cholesky factor, dimensions^2; NULL: independent */
};

/* Of the pairs given, all others independent. BAD_REQUEST if no such distribution exists. */
enum percuss_status copula_create(struct copula *copula, size_t dimensions,
                                  const struct copula_pair *pairs, size_t pair_count,
                                  struct fault *fault);
void copula_release(struct copula *copula);

/* Makes independent uniform numbers correlated, in place. */
void copula_apply(const struct copula *copula, double *point);

#endif
