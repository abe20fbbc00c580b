/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "base/hash.h"

#include <stdbool.h>
#include <string.h>

static const uint64_t MULTIPLIER_FIRST = 0x87c37b91114253d5u;
static const uint64_t MULTIPLIER_SECOND = 0x4cf5ad432745937fu;

static uint64_t hash_rotate(uint64_t x, int by)
{
    return x << by | x >> (64 - by);
}

static uint64_t hash_finish(uint64_t x)
{
    x = (x ^ x >> 33) * 0xff51afd7ed558ccdu;
    x = (x ^ x >> 33) * 0xc4ceb9fe1a85ec53u;
    return x ^ x >> 33;
}

static inline void hash_mix(struct hasher *hasher, uint64_t first, uint64_t second)
{
    hasher->first ^= hash_rotate(first * MULTIPLIER_FIRST, 31) * MULTIPLIER_SECOND;
    hasher->first = (hash_rotate(hasher->first, 27) + hasher->second) * 5 + 0x52dce729;
    hasher->second ^= hash_rotate(second * MULTIPLIER_SECOND, 33) * MULTIPLIER_FIRST;
    hasher->second = (hash_rotate(hasher->second, 31) + hasher->first) * 5 + 0x38495ab5;
}

static inline void mix_number(struct hasher *hasher, uint64_t number)
{
    hash_mix(hasher, number, ++hasher->length);
}

/* Mixes words of 8 bytes, two at a time, with zeros behind the last; copies of constant size cost
 * no call. */
void hash_bytes(struct hasher *hasher, const void *data, size_t size)
{
    enum { WORD = sizeof(uint64_t) };
    const unsigned char *at = data;
    struct hasher mixed = *hasher;
    mix_number(&mixed, size);
    for (; size >= 2 * WORD; size -= 2 * WORD, at += 2 * WORD) {
        uint64_t words[2];
        memcpy(words, at, sizeof words);
        hash_mix(&mixed, words[0], words[1]);
    }
    if (size > 0) {
        uint64_t words[2] = {0};
        bool whole = size >= WORD;
        if (whole)
            memcpy(words, at, WORD);
        if (size % WORD)
            memcpy(words + whole, at + whole * WORD, size % WORD);
        hash_mix(&mixed, words[0], words[1]);
    }
    *hasher = mixed;
}

void hash_text(struct hasher *hasher, const char *text)
{
    hash_bytes(hasher, text, strlen(text));
}

void hash_number(struct hasher *hasher, uint64_t number)
{
    mix_number(hasher, number);
}

struct digest hash_digest(const struct hasher *hasher)
{
    uint64_t first = hash_finish((hasher->first ^ hasher->length) + hasher->second);
    uint64_t second = hash_finish(hasher->second + first);
    return (struct digest){first + second, second + 2 * first};
}
