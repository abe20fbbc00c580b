/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Sobol's sequence with the direction numbers of Joe and Kuo 2008 (SIAM J. Sci. Comput. 30, 2635;
 * set D6). */
#ifndef PERCUSS_ENSEMBLE_SOBOL_H
#define PERCUSS_ENSEMBLE_SOBOL_H

#include <stdint.h>

enum { SOBOL_DIMENSIONS = 16, SOBOL_BITS = 32 };

/* One dimension's direction numbers, as binary fractions: directions[0] is 1/2. */
struct sobol_directions {
    uint32_t bit[SOBOL_BITS];
};

/* Of dimension 0 .. SOBOL_DIMENSIONS - 1. */
struct sobol_directions sobol_directions(unsigned dimension);

/* Coordinate `index` (below 2^32) as a binary fraction. */
uint32_t sobol_point(const struct sobol_directions *directions, uint64_t index);

#endif
