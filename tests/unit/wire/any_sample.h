/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A sample of any of our types with everything in it, and its bytes on the wire. */
#ifndef PERCUSS_TESTS_ANY_SAMPLE_H
#define PERCUSS_TESTS_ANY_SAMPLE_H

#include <dds/ddsi/ddsi_cdrstream.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "wire.h"

enum { XCDR1 = 1, XCDR2 = 2 };

static const struct {
    const dds_topic_descriptor_t *type;
    const char *topic;
} any_types[] = {
    {&percuss_v1_Request_desc, WIRE_TOPIC_REQUEST},
    {&percuss_v1_Reply_desc, WIRE_TOPIC_REPLY},
    {&percuss_v1_BatchRequest_desc, WIRE_TOPIC_BATCH_REQUEST},
    {&percuss_v1_BatchReply_desc, WIRE_TOPIC_BATCH_REPLY},
    {&percuss_v1_EnsembleRequest_desc, WIRE_TOPIC_ENSEMBLE_REQUEST},
    {&percuss_v1_EnsembleProgress_desc, WIRE_TOPIC_ENSEMBLE_PROGRESS},
    {&percuss_v1_EnsembleSamples_desc, WIRE_TOPIC_ENSEMBLE_SAMPLES},
    {&percuss_v1_EnsembleReply_desc, WIRE_TOPIC_ENSEMBLE_REPLY},
    {&percuss_v1_Trace_desc, WIRE_TOPIC_TRACE},
    {&percuss_v1_ServerStatus_desc, WIRE_TOPIC_SERVER_STATUS},
    {&percuss_v1_Body_desc, WIRE_TOPIC_BODY},
    {&percuss_v1_Dents_desc, WIRE_TOPIC_DENTS},
};
enum { ANY_TYPES = sizeof any_types / sizeof *any_types };

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

struct any_bytes {
    uint8_t *data;
    size_t size;
};

static inline struct any_bytes any_bytes_in(uint32_t version, const void *sample,
                                            const uint32_t *ops, bool swapped)
{
    dds_ostream_t stream;
    dds_ostream_init(&stream, 0, version);
    bool big = swapped == (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    dds_stream_write_with_byte_order(&stream, sample, ops, big ? DDSRT_BOSEL_BE : DDSRT_BOSEL_LE);
    struct any_bytes bytes = {malloc(stream.m_index), stream.m_index};
    memcpy(bytes.data, stream.m_buffer, bytes.size);
    dds_ostream_fini(&stream);
    return bytes;
}

static inline struct any_bytes any_bytes_of(const void *sample, const uint32_t *ops, bool swapped)
{
    return any_bytes_in(XCDR2, sample, ops, swapped);
}

/* One sample in this machine's byte order and in the other or the same, without the encapsulation
 * header; the caller frees both. */
static inline void any_sample_twice(const dds_topic_descriptor_t *type, struct any_bytes *native,
                                    struct any_bytes *other, bool swapped)
{
    void *sample = dds_alloc(type->m_size);
    memset(sample, 0, type->m_size);
    any_fill_struct(type->m_ops, sample);
    *native = any_bytes_of(sample, type->m_ops, false);
    *other = any_bytes_of(sample, type->m_ops, swapped);
    dds_sample_free(sample, type, DDS_FREE_ALL);
}

/* Without the encapsulation header; the caller frees them. */
static inline struct any_bytes any_sample(const dds_topic_descriptor_t *type, bool swapped)
{
    struct any_bytes native, bytes;
    any_sample_twice(type, &native, &bytes, swapped);
    free(native.data);
    return bytes;
}

/* Into the place of a length. */
static inline void any_put(uint8_t *at, size_t number, bool swapped)
{
    uint32_t word = swapped ? __builtin_bswap32((uint32_t)number) : (uint32_t)number;
    memcpy(at, &word, sizeof word);
}

#endif
