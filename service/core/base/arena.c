/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 32, BLOCK_SIZE = 1 << 18 };

/* Pieces of at most this size are cleared faster by a loop than by a call. */
enum { SMALL = 4 * ALIGNMENT };

struct arena_block {
    struct arena_block *next;
    size_t size;
    _Alignas(ALIGNMENT) unsigned char bytes[];
};

static size_t aligned(size_t bytes)
{
    return (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

static struct arena_block *block_create(size_t at_least)
{
    size_t size = at_least > BLOCK_SIZE ? at_least : BLOCK_SIZE;
    struct arena_block *block = aligned_alloc(ALIGNMENT, sizeof *block + size);
    if (block)
        *block = (struct arena_block){.size = size};
    return block;
}

static void arena_use(struct arena *arena, struct arena_block *block)
{
    arena->current = block;
    arena->next = block ? block->bytes : NULL;
    arena->left = block ? block->size : 0;
}

/* Continues in a block with more than `bytes` free, old ones first. False: out of memory. */
static bool arena_make_room(struct arena *arena, size_t bytes)
{
    if (bytes > SIZE_MAX - 4 * ALIGNMENT)
        return false;
    while (arena->left <= bytes && arena->current && arena->current->next)
        arena_use(arena, arena->current->next);
    if (arena->left > bytes)
        return true;
    struct arena_block *block = block_create(aligned(bytes + 1));
    if (!block)
        return false;
    arena->held += block->size;
    if (arena->current)
        arena->current->next = block;
    else
        arena->first = block;
    arena_use(arena, block);
    return true;
}

/* arena->left is a multiple of the alignment and exceeds `bytes`: the rounded size fits, too. */
static inline void *arena_put_aside(struct arena *arena, size_t bytes)
{
    void *memory = arena->next;
    arena->next += aligned(bytes);
    arena->left -= aligned(bytes);
    return memory;
}

/* The current block has no room: a rare case, kept out of the inlined common one. */
static __attribute__((noinline)) void *reserve_elsewhere(struct arena *arena, size_t count,
                                                         size_t size)
{
    size_t bytes;
    if (!__builtin_mul_overflow(count, size, &bytes) && arena_make_room(arena, bytes))
        return arena_put_aside(arena, bytes);
    arena->lacks = true;
    return NULL;
}

static __attribute__((noinline)) void *take_elsewhere(struct arena *arena, size_t count,
                                                      size_t size)
{
    void *memory = reserve_elsewhere(arena, count, size);
    return memory ? memset(memory, 0, count * size) : NULL;
}

void *arena_reserve(struct arena *arena, size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes >= arena->left)
        return reserve_elsewhere(arena, count, size);
    return arena_put_aside(arena, bytes);
}

void *arena_take(struct arena *arena, size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes >= arena->left)
        return take_elsewhere(arena, count, size);
    unsigned char *memory = arena_put_aside(arena, bytes);
    if (bytes > SMALL)
        return memset(memory, 0, bytes);
    for (unsigned char *unit = memory; unit < memory + bytes; unit += ALIGNMENT)
        memset(unit, 0, ALIGNMENT);
    return memory;
}

void arena_reset(struct arena *arena)
{
    arena->lacks = false;
    arena_use(arena, arena->first);
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
