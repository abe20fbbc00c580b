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
    unsigned char *next; /* free part of the current block, */
    size_t left;         /* its bytes, a multiple of the alignment */
    size_t held;         /* bytes of all blocks */
    bool lacks;          /* memory was out since the last reset: results may be incomplete */
};

/* 32-byte aligned, zeroed memory for `count` items of `size` bytes; NULL: out of memory, which
 * arena->lacks records for callers that cannot return an error at once. */
void *arena_take(struct arena *arena, size_t count, size_t size);

/* The same, not zeroed. */
void *arena_reserve(struct arena *arena, size_t count, size_t size);

/* Everything taken is free again; no memory goes back to the system. */
void arena_reset(struct arena *arena);

/* Gives all memory back. */
void arena_release(struct arena *arena);

#endif
