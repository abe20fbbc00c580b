/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_write.h"

#include <dds/dds.h>
#include <dds/ddsrt/heap.h>
#include <string.h>

static void grow(struct wire_block *block, size_t size)
{
    block->room = 2 * block->room + size;
    block->memory = ddsrt_realloc(block->memory, block->head + block->room);
}

/* Appends so many bytes where numbers of that size begin, and tells where that is. Before them are
 * zeros: four at once, for which there is room. */
static inline uint8_t *extend(struct wire_block *block, size_t alignment, size_t size)
{
    static const uint32_t zeros;
    const size_t before = block->size, begin = wire_plan_align(before, alignment);
    if (block->room - before < size + 2 * sizeof zeros)
        grow(block, size + 2 * sizeof zeros);
    uint8_t *data = block->memory + block->head;
    block->size = begin + size;
    memcpy(data + before, &zeros, sizeof zeros);
    return data + begin;
}

static inline void put_count(struct wire_block *block, uint32_t count)
{
    memcpy(extend(block, sizeof count, sizeof count), &count, sizeof count);
}

/* The size of what begins here, which fill_size() tells. */
static size_t leave_size(struct wire_block *block)
{
    put_count(block, 0);
    return block->size;
}

static void fill_size(struct wire_block *block, size_t begin)
{
    uint32_t size = (uint32_t)(block->size - begin);
    memcpy(block->memory + block->head + begin - sizeof size, &size, sizeof size);
}

static bool put_numbers(const struct wire_step *step, const void *numbers, size_t count,
                        struct wire_block *block)
{
    const uint8_t *booleans = numbers;
    for (size_t i = 0; step->booleans && i < count; i++)
        if (booleans[i] > 1)
            return false;
    if (count == 0)
        return true;
    const size_t size = step->size * count;
    memcpy(extend(block, step->size, size), numbers, size);
    return true;
}

static void put_text(const char *given, struct wire_block *block)
{
    const char *text = given ? given : "";
    const size_t size = strlen(text) + 1;
    put_count(block, (uint32_t)size);
    memcpy(extend(block, 1, size), text, size);
}

static bool put_struct(const struct wire_plan *plan, uint32_t first, const char *data,
                       struct wire_block *block);

static bool put_list(const struct wire_plan *plan, const struct wire_step *step,
                     const dds_sequence_t *list, struct wire_block *block)
{
    const char *element = (const char *)list->_buffer;
    bool numbers = step->element == WIRE_NUMBERS, good = true;
    if (step->bound && list->_length > step->bound)
        return false;
    size_t begin = numbers ? 0 : leave_size(block);
    put_count(block, list->_length);
    if (numbers)
        return put_numbers(step, element, list->_length, block);
    for (uint32_t i = 0; good && i < list->_length; i++, element += step->size) {
        if (step->element == WIRE_STRUCT)
            good = put_struct(plan, step->inner, element, block);
        else
            put_text(step->element == WIRE_TEXT ? element : *(char *const *)element, block);
    }
    fill_size(block, begin);
    return good;
}

static bool put_struct(const struct wire_plan *plan, uint32_t first, const char *data,
                       struct wire_block *block)
{
    bool good = true;
    size_t begin = leave_size(block);
    for (const struct wire_step *step = &plan->steps[first]; good && step->kind; step++) {
        const char *member = data + step->offset;
        if (step->kind == WIRE_NUMBERS)
            good = put_numbers(step, member, step->count, block);
        else if (step->kind == WIRE_TEXT)
            put_text(member, block);
        else if (step->kind == WIRE_STRING)
            put_text(*(char *const *)member, block);
        else if (step->kind == WIRE_STRUCT)
            good = put_struct(plan, step->inner, member, block);
        else
            good = put_list(plan, step, (const dds_sequence_t *)member, block);
    }
    fill_size(block, begin);
    return good;
}

bool wire_write(const struct wire_plan *plan, const void *sample, struct wire_block *block,
                size_t *padding)
{
    if (!put_struct(plan, plan->first, sample, block))
        return false;
    size_t written = block->size;
    extend(block, sizeof(uint32_t), 0);
    *padding = block->size - written;
    return true;
}
