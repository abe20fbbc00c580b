/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_sample.h"

#include <dds/ddsi/ddsi_cdrstream.h>
#include <dds/ddsi/q_protocol.h>
#include <dds/ddsrt/endian.h>
#include <dds/ddsrt/heap.h>
#include <dds/ddsrt/mh3.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "wire_read.h"
#include "wire_write.h"

/* Bytes of a sample that is written: most requests and replies; and the least of one that is taken,
 * more than what DDS keeps for reuse. */
enum { FIRST_ROOM = 1536, LEAST_ROOM = 320 };

static const struct wire_plan *plan_of(const struct wire_type *type)
{
    return __atomic_load_n(&type->plan, __ATOMIC_ACQUIRE);
}

/* Whether the bytes of a sample that DDS made are where the header says: it may have been built
 * with other members. */
static bool layout_is_known(const struct wire_type *type)
{
    const struct ddsi_sertype *common = &type->common.c;
    void *zeros = calloc(1, type->common.type.size);
    struct ddsi_serdata *key =
        zeros ? common->serdata_ops->from_sample(common, SDK_KEY, zeros) : NULL;
    bool known = false;
    if (key) {
        ddsrt_iovec_t bytes;
        struct ddsi_serdata *held = ddsi_serdata_to_ser_ref(key, 0, sizeof(uint32_t), &bytes);
        const uint8_t *expected = (const uint8_t *)key + offsetof(struct ddsi_serdata_default, hdr);
        known = (const uint8_t *)bytes.iov_base == expected;
        ddsi_serdata_to_ser_unref(held, &bytes);
        ddsi_serdata_unref(key);
    }
    free(zeros);
    return known;
}

void wire_sample_prepare(struct wire_type *type)
{
    const struct ddsi_sertype_default_desc *description = &type->common.type;
    if (plan_of(type) || !(description->flagset & DDS_TOPIC_FIXED_KEY_XCDR2) ||
        !layout_is_known(type))
        return;
    /* who comes second leaves the first one's */
    struct wire_plan *none = NULL, *plan = wire_plan_create(description->ops.ops);
    if (plan && !__atomic_compare_exchange_n(&type->plan, &none, plan, false, __ATOMIC_ACQ_REL,
                                             __ATOMIC_ACQUIRE))
        wire_plan_free(plan);
}

void wire_sample_forget(struct wire_type *type)
{
    wire_plan_free(type->plan);
}

/* The key of a sample, as whole types with short keys have it. */
static dds_ostream_t key_stream(struct ddsi_serdata_default *made)
{
    made->key.buftype = KEYBUFTYPE_STATIC;
    return (dds_ostream_t){.m_buffer = made->key.u.stbuf,
                           .m_size = sizeof made->key.u.stbuf,
                           .m_xcdr_version = CDR_ENC_VERSION_2};
}

static struct ddsi_serdata *finish(struct ddsi_serdata_default *made, const dds_ostream_t *key)
{
    made->key.keysize = key->m_index & SERDATA_DEFAULT_KEYSIZE_MASK;
    made->c.hash = ddsrt_mh3(made->key.u.stbuf, key->m_index, made->c.type->serdata_basehash);
    return &made->c;
}

/* Around bytes behind a head: what DDS makes for a sample of the type. */
static struct ddsi_serdata_default *begin(const struct wire_type *type, uint8_t *memory,
                                          size_t size, size_t room)
{
    struct ddsi_serdata_default *made = (struct ddsi_serdata_default *)memory;
    ddsi_serdata_init(&made->c, &type->common.c, SDK_DATA);
    made->pos = (uint32_t)size;
    made->size = (uint32_t)room;
    made->serpool = type->common.serpool;
    made->hdr.identifier =
        ddsi_sertype_get_native_enc_identifier(CDR_ENC_VERSION_2, type->common.encoding_format);
    made->hdr.options = 0;
    return made;
}

static struct ddsi_serdata *write_planned(const struct wire_type *type,
                                          const struct wire_plan *plan, const void *sample)
{
    const size_t head = offsetof(struct ddsi_serdata_default, data);
    struct wire_block block = {
        .memory = ddsrt_malloc(head + FIRST_ROOM), .head = head, .room = FIRST_ROOM};
    size_t padding;
    if (!wire_write(plan, sample, &block, &padding)) {
        ddsrt_free(block.memory);
        return NULL;
    }
    struct ddsi_serdata_default *made = begin(type, block.memory, block.size, block.room);
    made->hdr.options = ddsrt_toBE2u((uint16_t)padding);
    dds_ostream_t key = key_stream(made);
    dds_stream_write_key(&key, sample, &type->common);
    return finish(made, &key);
}

struct ddsi_serdata *wire_sample_write(const struct wire_type *type,
                                       const struct ddsi_serdata_ops *otherwise,
                                       enum ddsi_serdata_kind kind, const void *sample)
{
    const struct wire_plan *plan = kind == SDK_DATA ? plan_of(type) : NULL;
    return plan ? write_planned(type, plan, sample)
                : otherwise->from_sample(&type->common.c, kind, sample);
}

struct ddsi_serdata *wire_sample_take(const struct wire_type *type, const uint8_t *data,
                                      size_t size)
{
    const size_t head = offsetof(struct ddsi_serdata_default, data);
    const uint16_t native =
        ddsi_sertype_get_native_enc_identifier(CDR_ENC_VERSION_2, type->common.encoding_format);
    const struct wire_plan *plan = plan_of(type);
    struct CDRHeader header;
    if (!plan || size < sizeof header || size > INT32_MAX)
        return NULL;
    memcpy(&header, data, sizeof header);
    /* DDS takes only this bit of the padding's size */
    const size_t padding = ddsrt_fromBE2u(header.options) & 2, bytes = size - sizeof header;
    if (header.identifier != native || bytes < padding ||
        !wire_read_is_complete(plan, data + sizeof header, bytes - padding))
        return NULL;
    const size_t room = bytes < LEAST_ROOM ? LEAST_ROOM : bytes;
    uint8_t *memory = ddsrt_malloc(head + room);
    struct ddsi_serdata_default *made = begin(type, memory, bytes, room);
    made->hdr.options = header.options;
    memcpy(made->data, data + sizeof header, bytes);
    dds_ostream_t key = key_stream(made);
    dds_istream_t whole = {.m_buffer = (unsigned char *)made->data,
                           .m_size = (uint32_t)(bytes - padding),
                           .m_xcdr_version = CDR_ENC_VERSION_2};
    if (dds_stream_extract_key_from_data(&whole, &key, &type->common))
        return finish(made, &key);
    ddsrt_free(memory);
    return NULL;
}

bool wire_sample_read(const struct ddsi_serdata *taken, const struct ddsi_serdata_ops *otherwise,
                      void *sample, void **buffer, void *limit)
{
    const struct ddsi_serdata_default *made = (const struct ddsi_serdata_default *)taken;
    const struct wire_plan *plan =
        taken->kind == SDK_DATA ? plan_of((const struct wire_type *)taken->type) : NULL;
    /* what an older version has written lacks members, for which DDS has defaults */
    return (plan && wire_read(plan, (const uint8_t *)made->data, made->pos, sample)) ||
           otherwise->to_sample(taken, sample, buffer, limit);
}
