/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Points of the unit cube, each a function of its index: plain random points, Latin hypercubes,
 * Sobol's sequence; and their correlation. Latin hypercubes and Sobol's sequence come as
 * independent replicates (another permutation, another random scrambling), side by side: point i
 * belongs to replicate i mod R. Their spread tells the error of averages over all of them. */
#ifndef PERCUSS_ENSEMBLE_SAMPLING_H
#define PERCUSS_ENSEMBLE_SAMPLING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"
#include "numeric/random_stream.h"

/* Sobol's sequence with the direction numbers of Joe and Kuo 2008 (SIAM J. Sci. Comput. 30, 2635;
 * set D6). */

enum { SOBOL_DIMENSIONS = 16, SOBOL_BITS = 32 };

/* One dimension's direction numbers, as binary fractions: directions[0] is 1/2. */
struct sobol_directions {
    uint32_t bit[SOBOL_BITS];
};

/* Of dimension 0 .. SOBOL_DIMENSIONS - 1. */
struct sobol_directions sobol_directions(unsigned dimension);

/* Coordinate `index` (below 2^32) as a binary fraction. */
uint32_t sobol_point(const struct sobol_directions *directions, uint64_t index);

/* The numbers of SAMPLING_* on the wire. */
enum sampling_method {
    SAMPLING_IS_PLAIN,
    SAMPLING_IS_LATIN_HYPERCUBE,
    SAMPLING_IS_SOBOL,
    SAMPLING_METHODS
};
const char *sampling_name(unsigned method);

enum { SAMPLING_REPLICATES = 16, SAMPLING_MAX_DIMENSIONS = 64 };

/* Purposes of the streams of one seed. */
enum { STREAM_SAMPLES, STREAM_PILOTS, STREAM_SUBSTITUTES, STREAM_CHOSEN };

struct sampling {
    enum sampling_method method;
    size_t dimensions;
    uint64_t count;      /* points in all; of a Latin hypercube this decides where they lie */
    uint64_t replicates; /* 1 for plain points */
    struct random_stream stream;
    struct sobol_directions sobol[SOBOL_DIMENSIONS];
};

/* `count` is rounded up to whole replicates. BAD_REQUEST: too many dimensions for Sobol. */
enum percuss_status sampling_create(struct sampling *sampling, enum sampling_method method,
                                    size_t dimensions, uint64_t count, uint64_t seed,
                                    struct fault *fault);

/* Point `index` < count: `dimensions` numbers in (0, 1). */
void sampling_point(const struct sampling *sampling, uint64_t index, double *point);

/* One of them. */
double sampling_coordinate(const struct sampling *sampling, uint64_t index, size_t dimension);

/* Correlated inputs by a Gaussian copula: the coefficients are those of the normal scores, whatever
 * the distributions are. */

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
