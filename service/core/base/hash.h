/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A 128-bit hash of the content of a request or a state. The bits mix as in MurmurHash3 x64 128
 * (Austin Appleby, public domain), which is fast and spreads well but does not resist an attacker:
 * look-ups compare the content where a collision would matter. */
#ifndef PERCUSS_BASE_HASH_H
#define PERCUSS_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

struct digest {
    uint64_t first, second;
};

struct hasher {
    uint64_t first, second, length;
};

/* Start with a zeroed hasher. Every piece goes in with its length, so that ("ab", "c") and
 * ("a", "bc") differ. */
void hash_bytes(struct hasher *hasher, const void *data, size_t size);
void hash_text(struct hasher *hasher, const char *text);
void hash_number(struct hasher *hasher, uint64_t number);

/* The hash of all pieces so far. */
struct digest hash_digest(const struct hasher *hasher);

#endif
