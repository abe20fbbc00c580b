/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How idlc's instructions for a type are read: for whoever walks over its samples. */
#ifndef PERCUSS_WIRE_OPS_H
#define PERCUSS_WIRE_OPS_H

#include <dds/dds.h>

/* Bytes of a number or a boolean; 0: the type is something else. */
static inline size_t wire_ops_number_size(enum dds_stream_typecode type)
{
    switch (type) {
    case DDS_OP_VAL_BLN:
    case DDS_OP_VAL_1BY:
        return 1;
    case DDS_OP_VAL_2BY:
        return 2;
    case DDS_OP_VAL_4BY:
        return 4;
    case DDS_OP_VAL_8BY:
        return 8;
    default:
        return 0;
    }
}

/* What the instruction of a sequence says. */
struct wire_ops_list {
    enum dds_stream_typecode type;
    uint32_t bound;                   /* 0: none */
    size_t size;                      /* of an element in memory; 0: of a kind that we do not use */
    const uint32_t *elements, *after; /* instructions */
};

static inline struct wire_ops_list wire_ops_read_list(const uint32_t *ops)
{
    bool bounded = DDS_OP_TYPE(*ops) == DDS_OP_VAL_BSQ;
    const uint32_t *words = ops + 2 + bounded;
    struct wire_ops_list list = {
        .type = DDS_OP_SUBTYPE(*ops), .bound = bounded ? ops[2] : 0, .after = words};
    list.size = wire_ops_number_size(list.type);
    if (list.type == DDS_OP_VAL_STR) {
        list.size = sizeof(char *);
    } else if (list.type == DDS_OP_VAL_BST) {
        list.size = words[0];
        list.after = words + 1;
    } else if (list.type == DDS_OP_VAL_STU) {
        list.size = words[0];
        list.elements = ops + DDS_OP_ADR_JSR(words[1]);
        list.after = DDS_OP_ADR_JMP(words[1]) ? ops + DDS_OP_ADR_JMP(words[1]) : words + 2;
    }
    return list;
}

static inline bool wire_ops_is_list(uint32_t instruction)
{
    return DDS_OP_TYPE(instruction) == DDS_OP_VAL_SEQ || DDS_OP_TYPE(instruction) == DDS_OP_VAL_BSQ;
}

/* Whether a member is of a kind that our types have. */
static inline bool wire_ops_are_known(const uint32_t *ops)
{
    if (DDS_OP(*ops) != DDS_OP_ADR || DDS_OP_TYPE_FLAGS(*ops) ||
        (DDS_OP_FLAGS(*ops) & (DDS_OP_FLAG_OPT | DDS_OP_FLAG_BASE)))
        return false;
    enum dds_stream_typecode type = DDS_OP_TYPE(*ops);
    if (type == DDS_OP_VAL_ARR)
        return wire_ops_number_size(DDS_OP_SUBTYPE(*ops)) > 0;
    if (wire_ops_is_list(*ops))
        return wire_ops_read_list(ops).size > 0;
    return wire_ops_number_size(type) || type == DDS_OP_VAL_STR || type == DDS_OP_VAL_BST ||
           type == DDS_OP_VAL_EXT;
}

static inline const uint32_t *wire_ops_next(const uint32_t *ops)
{
    if (wire_ops_is_list(*ops))
        return wire_ops_read_list(ops).after;
    switch (DDS_OP_TYPE(*ops)) {
    case DDS_OP_VAL_BST:
    case DDS_OP_VAL_ARR:
        return ops + 3;
    case DDS_OP_VAL_EXT:
        return ops + (DDS_OP_ADR_JMP(ops[2]) ? DDS_OP_ADR_JMP(ops[2]) : 3);
    default:
        return ops + 2;
    }
}

#endif
