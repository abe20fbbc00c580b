/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Memory of one solve: handed out in pieces, given back all at once. */
#ifndef PERCUSS_BASE_ARENA_H
#define PERCUSS_BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

struct arena_block;

struct arena {
    struct arena_block *first; /* all blocks, kept for reuse */
    struct arena_block *current;
    unsigned char *next; /* of the current block what is free, */
    size_t left;         /* a multiple of the alignment */
    bool lacks;          /* since the last reset memory was out: what was made of it is not whole */
};

/* 32-byte aligned, zeroed memory for `count` items of `size` bytes; NULL: out of memory, which
 * arena->lacks remembers for who cannot say so at once. */
void *arena_take(struct arena *arena, size_t count, size_t size);

/* The same, not zeroed. */
void *arena_reserve(struct arena *arena, size_t count, size_t size);

/* Everything taken is free again; no memory goes back to the system. */
void arena_reset(struct arena *arena);

/* Gives all memory back. */
void arena_release(struct arena *arena);

#endif
