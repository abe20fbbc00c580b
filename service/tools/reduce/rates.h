/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How fast this machine computes, now, with all that it does besides: what estimates of time follow
 * from. */
#ifndef PERCUSS_REDUCE_RATES_H
#define PERCUSS_REDUCE_RATES_H

#include <stdbool.h>
#include <stddef.h>

#include "reduce/factor.h"

/* Operations a second of one process. */
struct rates {
    double square; /* products of matrices that the caches hold, as in factors */
    double thin;   /* of a matrix from memory and a few vectors, as in solutions and projections */
};

/* Takes some hundredths of a second. False: no memory. */
bool rates_measure(struct rates *rates);

/* Seconds of one process: for a factor, for a solution in blocks of so many columns, and for a
 * product of a symmetric sparse matrix, of so many entries up to the diagonal, with one of a block
 * of vectors. */
double rates_factor(const struct rates *rates, const struct factor_cost *cost);
double rates_solution(const struct rates *rates, const struct factor_cost *cost, size_t together);
double rates_product(const struct rates *rates, size_t entries);

/* Seconds of a clock. */
double rates_clock(void);

#endif
