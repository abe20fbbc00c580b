/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* SHA-256 (FIPS 180-4): identifies the files from which a result was computed. */
#ifndef PERCUSS_BASE_SHA256_H
#define PERCUSS_BASE_SHA256_H

#include <stddef.h>
#include <stdint.h>

enum { SHA256_TEXT = 65, SHA256_BLOCK = 64 };

struct sha256 {
    uint32_t state[8];
    uint64_t length; /* bytes so far */
    unsigned char block[SHA256_BLOCK];
};

struct sha256 sha256_begin(void);
void sha256_add(struct sha256 *hash, const void *data, size_t size);
/* Writes the hash in hexadecimal, zero-terminated; no bytes can be added afterwards. */
void sha256_end(struct sha256 *hash, char text[SHA256_TEXT]);

#endif
