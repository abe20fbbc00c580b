/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 32, BLOCK_SIZE = 1 << 18 };

struct arena_block {
    struct arena_block *next;
    size_t size, used;
    _Alignas(ALIGNMENT) unsigned char bytes[];
};

static struct arena_block *block_create(size_t at_least)
{
    size_t size = at_least > BLOCK_SIZE ? at_least : BLOCK_SIZE;
    struct arena_block *block = aligned_alloc(ALIGNMENT, sizeof *block + size);
    if (block)
        *block = (struct arena_block){.size = size};
    return block;
}

static bool has_room(const struct arena_block *block, size_t bytes)
{
    return block && block->size - block->used >= bytes;
}

/* The next block with room, old ones first; seldom, and kept out of what is often. */
static __attribute__((noinline)) struct arena_block *block_with_room(struct arena *arena,
                                                                     size_t bytes)
{
    while (arena->current && !has_room(arena->current, bytes) && arena->current->next) {
        arena->current = arena->current->next;
        arena->current->used = 0;
    }
    if (has_room(arena->current, bytes))
        return arena->current;
    struct arena_block *block = block_create(bytes);
    if (!block)
        return NULL;
    if (arena->current)
        arena->current->next = block;
    else
        arena->first = block;
    arena->current = block;
    return block;
}

void *arena_reserve(struct arena *arena, size_t count, size_t size)
{
    size_t bytes;
    struct arena_block *block = NULL;
    if (!__builtin_mul_overflow(count, size, &bytes) && bytes <= SIZE_MAX - 2 * ALIGNMENT) {
        bytes = (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
        block = has_room(arena->current, bytes) ? arena->current : block_with_room(arena, bytes);
    }
    if (!block) {
        arena->lacks = true;
        return NULL;
    }
    void *memory = block->bytes + block->used;
    block->used += bytes;
    return memory;
}

void *arena_take(struct arena *arena, size_t count, size_t size)
{
    void *memory = arena_reserve(arena, count, size);
    return memory ? memset(memory, 0, count * size) : NULL;
}

void arena_reset(struct arena *arena)
{
    arena->lacks = false;
    arena->current = arena->first;
    if (arena->current)
        arena->current->used = 0;
}

void arena_release(struct arena *arena)
{
    for (struct arena_block *block = arena->first; block;) {
        struct arena_block *next = block->next;
        free(block);
        block = next;
    }
    *arena = (struct arena){0};
}
