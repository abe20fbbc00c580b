/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/random_stream.h"

#include <Random123/philox.h>

enum { FEISTEL_ROUNDS = 6 };

uint64_t random_bits(const struct random_stream *stream, uint64_t index, uint64_t dimension)
{
    philox4x64_ctr_t counter = {{index, dimension / 4, 0, 0}};
    philox4x64_key_t key = {{stream->seed, stream->purpose}};
    return philox4x64(counter, key).v[dimension % 4];
}

double random_uniform_of(uint64_t bits)
{
    return (double)(bits >> 12) * 0x1p-52 + 0x1p-53;
}

double random_uniform(const struct random_stream *stream, uint64_t index, uint64_t dimension)
{
    return random_uniform_of(random_bits(stream, index, dimension));
}

uint32_t random_hash(uint64_t key, uint32_t first, uint32_t second)
{
    philox2x32_ctr_t counter = {{first, second ^ (uint32_t)(key >> 32)}};
    philox2x32_key_t word = {{(uint32_t)key}};
    return philox2x32(counter, word).v[0];
}

/* One pass over numbers of 2 x `half` bits. */
static uint64_t feistel(uint64_t key, uint64_t value, unsigned half)
{
    uint64_t mask = (UINT64_C(1) << half) - 1;
    uint64_t left = value >> half, right = value & mask;
    for (uint32_t round = 0; round < FEISTEL_ROUNDS; round++) {
        uint64_t next = left ^ (random_hash(key, (uint32_t)right, round) & mask);
        left = right;
        right = next;
    }
    return left << half | right;
}

uint64_t random_permute(uint64_t key, uint64_t index, uint64_t count)
{
    unsigned half = 1;
    while (UINT64_C(1) << 2 * half < count)
        half++;
    do
        index = feistel(key, index, half);
    while (index >= count);
    return index;
}
