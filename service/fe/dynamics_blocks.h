/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Elements of a level in blocks of four, with a history or without. */
#ifndef PERCUSS_FE_DYNAMICS_BLOCKS_H
#define PERCUSS_FE_DYNAMICS_BLOCKS_H

#include "fe/dynamics.h"

/* 0 or 1: the body an element belongs to. */
static inline size_t dynamics_body_of(const struct dynamics *dynamics, size_t element)
{
    return element >= dynamics->first_element[1];
}

/* False: degenerate. */
bool dynamics_quad(const struct dynamics *dynamics, size_t element, struct quad *quad);

/* Packs level k, nothing with a history yet. False: out of memory. */
bool dynamics_blocks_make(struct dynamics *dynamics, unsigned k);

#endif
