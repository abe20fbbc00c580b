/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A sample of any of our types with everything in it, and its bytes on the wire. */
#ifndef PERCUSS_TESTS_ANY_SAMPLE_H
#define PERCUSS_TESTS_ANY_SAMPLE_H

#include "unit/wire/any_value.h"
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
