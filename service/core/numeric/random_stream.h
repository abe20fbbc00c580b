/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Random numbers as a function of their place, not of the order of calls: Philox 4x64-10 (Salmon et
 * al. 2011, SC11) from Random123. The same (seed, purpose, index, dimension) gives the same bits on
 * any worker, in any order. */
#ifndef PERCUSS_NUMERIC_RANDOM_STREAM_H
#define PERCUSS_NUMERIC_RANDOM_STREAM_H

#include <stdint.h>

/* Streams of one seed are independent. */
struct random_stream {
    uint64_t seed, purpose;
};

/* 64 random bits. */
uint64_t random_bits(const struct random_stream *stream, uint64_t index, uint64_t dimension);

/* Uniform in (0, 1): odd multiples of 2^-53, so that neither end occurs. */
double random_uniform(const struct random_stream *stream, uint64_t index, uint64_t dimension);

/* The same of 64 given bits. */
double random_uniform_of(uint64_t bits);

/* Place of `index` in a random permutation of 0 .. count - 1, computed alone: a Feistel network
 * on the next power of four, walked until it falls below `count`. Permutations of different keys
 * (64 random bits) are independent. */
uint64_t random_permute(uint64_t key, uint64_t index, uint64_t count);

/* 32 random bits for a pair of numbers under a key. */
uint32_t random_hash(uint64_t key, uint32_t first, uint32_t second);

#endif
