/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One walk checks and reads: where it only checks, there is no memory to read into (NULL). */
#include "wire_read.h"

#include <dds/dds.h>
#include <dds/ddsrt/heap.h>
#include <string.h>

/* As in wire_whole.c. */
static const uint32_t largest_list = 64 << 20; /* bytes */

/* What is left of the innermost struct or list. */
struct cursor {
    const uint8_t *data;
    size_t at, end;
};

/* Past `count` numbers of `size` bytes each; NULL: there are not so many. */
static inline const uint8_t *pass(struct cursor *cursor, size_t size, size_t count)
{
    size_t at = wire_plan_align(cursor->at, size), bytes = size * count;
    if (at > cursor->end || bytes > cursor->end - at)
        return NULL;
    cursor->at = at + bytes;
    return cursor->data + at;
}

static inline bool take_count(struct cursor *cursor, uint32_t *count)
{
    const uint8_t *bytes = pass(cursor, sizeof *count, 1);
    if (bytes)
        memcpy(count, bytes, sizeof *count);
    return bytes;
}

/* Into what has its size in front. */
static inline bool enter(const struct cursor *outer, struct cursor *inner)
{
    uint32_t size;
    *inner = *outer;
    if (!take_count(inner, &size) || size > inner->end - inner->at)
        return false;
    inner->end = inner->at + size;
    return true;
}

static bool take_numbers(const struct wire_step *step, size_t count, struct cursor *cursor,
                         char *memory)
{
    const uint8_t *numbers = pass(cursor, step->size, count);
    if (!numbers)
        return false;
    for (size_t i = 0; step->booleans && i < count; i++)
        if (numbers[i] > 1)
            return false;
    const size_t size = step->size * count;
    /* most stand alone, and a call costs more than their copy */
    if (memory && size == sizeof(uint64_t))
        memcpy(memory, numbers, sizeof(uint64_t));
    else if (memory)
        memcpy(memory, numbers, size);
    return true;
}

/* A text with its end, and its size with that, of at most `most` bytes; NULL: it is none. */
static const char *pass_text(struct cursor *cursor, uint32_t most, uint32_t *size)
{
    if (!take_count(cursor, size) || *size == 0 || *size > most)
        return NULL;
    const char *text = (const char *)pass(cursor, 1, *size);
    return text && text[*size - 1] == '\0' ? text : NULL;
}

static bool take_text(uint32_t room, struct cursor *cursor, char *memory)
{
    uint32_t size;
    const char *text = pass_text(cursor, room, &size);
    if (text && memory)
        memcpy(memory, text, size);
    return text;
}

static bool take_string(struct cursor *cursor, char **memory)
{
    uint32_t size;
    const char *text = pass_text(cursor, UINT32_MAX, &size);
    if (!text || !memory)
        return text;
    if (!*memory || strlen(*memory) + 1 < size)
        *memory = ddsrt_realloc(*memory, size);
    memcpy(*memory, text, size);
    return true;
}

/* Room for `count` elements, new ones zeroed; false: the list is too short and not its own. */
static bool prepare_list(const struct wire_step *step, dds_sequence_t *list, uint32_t count)
{
    if (list->_length > list->_maximum)
        list->_maximum = list->_length;
    if (count > list->_maximum) {
        if (list->_maximum > 0 && !list->_release)
            return false;
        size_t before = (size_t)step->size * list->_maximum, after = (size_t)step->size * count;
        uint8_t *buffer = ddsrt_realloc(list->_maximum > 0 ? list->_buffer : NULL, after);
        memset(buffer + before, 0, after - before);
        list->_buffer = buffer;
        list->_maximum = count;
        list->_release = true;
    }
    list->_length = count;
    return true;
}

static bool take_struct(const struct wire_plan *plan, uint32_t first, struct cursor *cursor,
                        char *memory);

static bool take_elements(const struct wire_plan *plan, const struct wire_step *step,
                          uint32_t count, struct cursor *cursor, char *memory)
{
    bool good = true;
    for (uint32_t i = 0; good && i < count; i++) {
        char *element = memory ? memory + (size_t)step->size * i : NULL;
        if (step->element == WIRE_STRUCT)
            good = take_struct(plan, step->inner, cursor, element);
        else if (step->element == WIRE_TEXT)
            good = take_text(step->size, cursor, element);
        else
            good = take_string(cursor, (char **)element);
    }
    return good;
}

static bool take_list(const struct wire_plan *plan, const struct wire_step *step,
                      struct cursor *cursor, dds_sequence_t *list)
{
    bool numbers = step->element == WIRE_NUMBERS;
    struct cursor inner = *cursor;
    uint32_t count;
    if ((!numbers && !enter(cursor, &inner)) || !take_count(&inner, &count) ||
        (step->bound && count > step->bound) ||
        count > (numbers ? UINT32_MAX : largest_list) / step->size)
        return false;
    /* not before it is known that numbers are there */
    struct cursor ahead = inner;
    if ((numbers && count > 0 && !pass(&ahead, step->size, count)) ||
        (list && !prepare_list(step, list, count)))
        return false;
    char *memory = list ? (char *)list->_buffer : NULL;
    bool good = count == 0 || (numbers ? take_numbers(step, count, &inner, memory)
                                       : take_elements(plan, step, count, &inner, memory));
    cursor->at = inner.at;
    return good && (numbers || inner.at == inner.end);
}

static bool take_struct(const struct wire_plan *plan, uint32_t first, struct cursor *cursor,
                        char *memory)
{
    struct cursor inner;
    bool good = enter(cursor, &inner);
    for (const struct wire_step *step = &plan->steps[first]; good && step->kind; step++) {
        char *member = memory ? memory + step->offset : NULL;
        if (step->kind == WIRE_NUMBERS)
            good = take_numbers(step, step->count, &inner, member);
        else if (step->kind == WIRE_TEXT)
            good = take_text(step->size, &inner, member);
        else if (step->kind == WIRE_STRING)
            good = take_string(&inner, (char **)member);
        else if (step->kind == WIRE_STRUCT)
            good = take_struct(plan, step->inner, &inner, member);
        else
            good = take_list(plan, step, &inner, (dds_sequence_t *)member);
    }
    /* members that a newer version has appended */
    cursor->at = inner.end;
    return good;
}

bool wire_read(const struct wire_plan *plan, const uint8_t *data, size_t size, void *sample)
{
    struct cursor cursor = {.data = data, .end = size};
    return take_struct(plan, plan->first, &cursor, sample);
}

bool wire_read_is_complete(const struct wire_plan *plan, const uint8_t *data, size_t size)
{
    return wire_read(plan, data, size, NULL);
}
