/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Something in every member of a sample, by what Cyclone DDS's compiler of IDL says of its type. */
#ifndef PERCUSS_TESTS_ANY_VALUE_H
#define PERCUSS_TESTS_ANY_VALUE_H

#include <dds/ddsi/ddsi_cdrstream.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The same numbers in every run. */
static inline uint32_t any_number(void)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 33);
}

static inline size_t any_number_size(enum dds_stream_typecode type)
{
    return type == DDS_OP_VAL_BLN ? 1 : type <= DDS_OP_VAL_8BY ? (size_t)1 << (type - 1) : 0;
}

static inline void any_fill_struct(const uint32_t *ops, char *data);

static inline void any_fill(enum dds_stream_typecode type, char *data, size_t count,
                            const uint32_t *elements, size_t size)
{
    for (size_t i = 0; i < count; i++, data += size) {
        if (type == DDS_OP_VAL_STU)
            any_fill_struct(elements, data);
        else if (type == DDS_OP_VAL_BST)
            memset(data, 'a', any_number() % size); /* zeroed before */
        else if (type == DDS_OP_VAL_STR)
            *(char **)data = dds_string_dup("text");
        else if (type == DDS_OP_VAL_BLN)
            *data = any_number() % 2;
        else
            for (size_t byte = 0; byte < size; byte++)
                data[byte] = (char)any_number();
    }
}

/* Fills a sequence with two or three elements, or up to fifty numbers, and returns the next
 * instruction. */
static inline const uint32_t *any_fill_list(const uint32_t *ops, dds_sequence_t *list)
{
    enum dds_stream_typecode type = DDS_OP_SUBTYPE(*ops);
    bool bounded = DDS_OP_TYPE(*ops) == DDS_OP_VAL_BSQ;
    const uint32_t *words = ops + 2 + bounded;
    bool structs = type == DDS_OP_VAL_STU;
    size_t size = type == DDS_OP_VAL_STR ? sizeof(char *)
                  : structs              ? words[0]
                                         : any_number_size(type);
    list->_length =
        bounded && ops[2] < 2 ? ops[2] : 2 + any_number() % (any_number_size(type) ? 49 : 2);
    list->_maximum = list->_length;
    list->_release = true;
    list->_buffer = dds_alloc(list->_length * size);
    memset(list->_buffer, 0, list->_length * size);
    const uint32_t *elements = structs ? ops + DDS_OP_ADR_JSR(words[1]) : NULL;
    any_fill(type, (char *)list->_buffer, list->_length, elements, size);
    return structs ? ops + DDS_OP_ADR_JMP(words[1]) : words;
}

static inline void any_fill_struct(const uint32_t *ops, char *data)
{
    for (ops += DDS_OP(*ops) == DDS_OP_DLC; *ops != DDS_OP_RTS;) {
        enum dds_stream_typecode type = DDS_OP_TYPE(*ops);
        char *member = data + ops[1];
        if (type == DDS_OP_VAL_SEQ || type == DDS_OP_VAL_BSQ) {
            ops = any_fill_list(ops, (dds_sequence_t *)member);
        } else if (type == DDS_OP_VAL_EXT) {
            any_fill_struct(ops + DDS_OP_ADR_JSR(ops[2]), member);
            ops += DDS_OP_ADR_JMP(ops[2]);
        } else if (type == DDS_OP_VAL_ARR) {
            type = DDS_OP_SUBTYPE(*ops);
            any_fill(type, member, ops[2], NULL, any_number_size(type));
            ops += 3;
        } else {
            bool text = type == DDS_OP_VAL_BST;
            any_fill(type, member, 1, NULL, text ? ops[2] : any_number_size(type));
            ops += text ? 3 : 2;
        }
    }
}

#endif
