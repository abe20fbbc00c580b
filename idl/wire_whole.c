/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_whole.h"

#include <string.h>

#include "wire_ops.h"

/* Elements that have left out their members take a hundred times in memory what they take on the
 * wire. */
static const uint32_t largest_list = 64 << 20; /* bytes */

/* What is left of the innermost struct or list. */
struct cursor {
    const uint8_t *data;
    size_t at, end;
    bool first; /* XCDR1 */
    bool swapped;
};

/* Past `count` numbers of `size` bytes each. In XCDR2 nothing is aligned to more than 4. */
static bool skip(struct cursor *cursor, size_t size, size_t count)
{
    size_t alignment = size < 4 || cursor->first ? size : 4;
    size_t at = (cursor->at + alignment - 1) & ~(alignment - 1);
    if (at > cursor->end || count > (cursor->end - at) / size)
        return false;
    cursor->at = at + size * count;
    return true;
}

static bool read_number(struct cursor *cursor, uint32_t *number)
{
    if (!skip(cursor, sizeof *number, 1))
        return false;
    memcpy(number, cursor->data + cursor->at - sizeof *number, sizeof *number);
    if (cursor->swapped)
        *number = __builtin_bswap32(*number);
    return true;
}

/* Into what has its size in front: an @appendable struct, a list of anything but numbers. In XCDR1
 * nothing has. */
static bool enter(const struct cursor *outer, struct cursor *inner)
{
    uint32_t size;
    *inner = *outer;
    if (outer->first)
        return true;
    if (!read_number(inner, &size) || size > inner->end - inner->at)
        return false;
    inner->end = inner->at + size;
    return true;
}

static bool check_string(struct cursor *cursor)
{
    uint32_t size;
    return read_number(cursor, &size) && skip(cursor, 1, size);
}

static bool check_struct(const uint32_t *ops, struct cursor *cursor);

static bool check_elements(const struct wire_ops_list *list, uint32_t count, struct cursor *cursor)
{
    bool good = true;
    for (uint32_t i = 0; good && i < count; i++)
        good = list->elements ? check_struct(list->elements, cursor) : check_string(cursor);
    return good;
}

static bool check_list(const uint32_t *ops, struct cursor *cursor)
{
    struct wire_ops_list list = wire_ops_read_list(ops);
    struct cursor inner = *cursor;
    size_t number = wire_ops_number_size(list.type);
    uint32_t count;
    if ((number == 0 && !enter(cursor, &inner)) || !read_number(&inner, &count) ||
        (list.bound && count > list.bound))
        return false;
    /* numbers take what they take on the wire, and DDS counts bytes with 32 bits */
    if (count > (number ? UINT32_MAX : largest_list) / list.size)
        return false;
    bool good =
        number ? count == 0 || skip(&inner, number, count)
               : check_elements(&list, count, &inner) && (cursor->first || inner.at == inner.end);
    cursor->at = inner.at;
    return good;
}

static bool check_member(const uint32_t *ops, struct cursor *cursor)
{
    enum dds_stream_typecode type = DDS_OP_TYPE(*ops);
    if (wire_ops_number_size(type))
        return skip(cursor, wire_ops_number_size(type), 1);
    if (type == DDS_OP_VAL_ARR)
        return skip(cursor, wire_ops_number_size(DDS_OP_SUBTYPE(*ops)), ops[2]);
    if (type == DDS_OP_VAL_EXT)
        return check_struct(ops + DDS_OP_ADR_JSR(ops[2]), cursor);
    return wire_ops_is_list(*ops) ? check_list(ops, cursor) : check_string(cursor);
}

static bool may_be_missing(uint32_t instruction)
{
    return !(DDS_OP_FLAGS(instruction) & DDS_OP_FLAG_KEY) &&
           DDS_OP_TYPE(instruction) != DDS_OP_VAL_EXT;
}

static bool check_struct(const uint32_t *ops, struct cursor *cursor)
{
    struct cursor inner = *cursor;
    bool appendable = DDS_OP(*ops) == DDS_OP_DLC;
    if (appendable && (cursor->first || !enter(cursor, &inner)))
        return false;
    for (ops += appendable; *ops != DDS_OP_RTS; ops = wire_ops_next(ops)) {
        bool missing = appendable && inner.at == inner.end;
        if (!wire_ops_are_known(ops) ||
            !(missing ? may_be_missing(*ops) : check_member(ops, &inner)))
            return false;
    }
    /* members that a newer version has appended */
    cursor->at = appendable ? inner.end : inner.at;
    return true;
}

bool wire_whole_in(int version, const uint32_t *ops, const void *data, size_t size, bool swapped)
{
    struct cursor cursor = {.data = data, .end = size, .first = version == 1, .swapped = swapped};
    return check_struct(ops, &cursor);
}

bool wire_whole(const uint32_t *ops, const void *data, size_t size, bool swapped)
{
    return wire_whole_in(2, ops, data, size, swapped);
}
