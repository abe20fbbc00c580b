/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Repeatable random numbers for permutations and synthetic noise: splitmix64 (Steele, Lea, Flood
 * 2014); its state is a counter. */
#ifndef PERCUSS_MEASURED_RANDOM_H
#define PERCUSS_MEASURED_RANDOM_H

#include <math.h>
#include <stdint.h>

struct random {
    uint64_t state; /* the seed */
};

static inline uint64_t random_bits(struct random *random)
{
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Uniform in (0, 1). */
static inline double random_uniform(struct random *random)
{
    return ((double)(random_bits(random) >> 11) + 0.5) * 0x1p-53;
}

/* Normal with mean 0 and deviation 1 (Box and Muller). */
static inline double random_normal(struct random *random)
{
    double radius = sqrt(-2.0 * log(random_uniform(random)));
    return radius * cos(2.0 * M_PI * random_uniform(random));
}

#endif
