/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "storage.h"

#include <stdalign.h>
#include <stdlib.h>
#include <string.h>

/* Of a block; the reply of most impacts needs one. */
static const size_t LEAST_ROOM = 4096;

struct storage_block {
    struct storage_block *next;
    size_t used, room;
    max_align_t memory[];
};

/* As storage_take, not zeroed: of most replies a block is half empty. */
static void *reserve(struct storage *storage, size_t count, size_t size)
{
    size_t grain = alignof(max_align_t), bytes = (count * size + grain - 1) / grain * grain;
    struct storage_block *block = storage->blocks;
    if (!block || block->room - block->used < bytes) {
        size_t room = bytes > LEAST_ROOM ? bytes : LEAST_ROOM;
        block = malloc(sizeof *block + room);
        storage->failed = storage->failed || !block;
        if (!block)
            return NULL;
        *block = (struct storage_block){.next = storage->blocks, .room = room};
        storage->blocks = block;
    }
    void *taken = (char *)block->memory + block->used;
    block->used += bytes;
    return taken;
}

void *storage_take(struct storage *storage, size_t count, size_t size)
{
    void *taken = reserve(storage, count, size);
    if (taken)
        memset(taken, 0, count * size);
    return taken;
}

void *storage_copy(struct storage *storage, const void *source, size_t count, size_t size)
{
    void *copy = reserve(storage, count, size);
    if (copy && count > 0)
        memcpy(copy, source, count * size);
    return copy;
}

void storage_free(struct storage_block *blocks)
{
    while (blocks) {
        struct storage_block *next = blocks->next;
        free(blocks);
        blocks = next;
    }
}
