/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A single reply as bytes to be stored and sent again: XCDR2 as on the wire, little-endian. */
#ifndef PERCUSS_ENDPOINT_REPLY_BYTES_H
#define PERCUSS_ENDPOINT_REPLY_BYTES_H

#include "exchange/answer.h"

/* The bytes of an answer of EXCHANGE_SINGLE, for the caller to free(); NULL: no memory. */
void *reply_bytes_write(const struct answer *answer, size_t *size);

/* The answer again; NULL: damaged bytes, or else no memory. */
struct answer *reply_bytes_read(const void *bytes, size_t size, bool *damaged);

#endif
