/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Samples as bytes of XCDR2: the same that Cyclone DDS writes. */
#ifndef PERCUSS_WIRE_WRITE_H
#define PERCUSS_WIRE_WRITE_H

#include "wire_plan.h"

/* A block of memory of ddsrt_malloc, which may move: `head` bytes of the caller's, then the sample.
 */
struct wire_block {
    uint8_t *memory;
    size_t head, size; /* bytes before and of the sample */
    size_t room;       /* for the sample */
};

/* Appends the sample to a block with none, and zeros up to a multiple of 4, `padding` bytes. False:
 * the sample cannot be written: a boolean is neither 0 nor 1, or a list longer than its bound. */
bool wire_write(const struct wire_plan *plan, const void *sample, struct wire_block *block,
                size_t *padding);

#endif
