/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_topic.h"

#include <dds/ddsi/ddsi_cdrstream.h>
#include <dds/ddsi/ddsi_domaingv.h>
#include <dds/ddsi/q_radmin.h>
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "wire.h"
#include "wire_hand.h"
#include "wire_sample.h"
#include "wire_whole.h"

enum { ENCAPSULATION = 4, LARGEST_HEAD = 512 };

/* Those of Cyclone DDS for keyed types in XCDR2 and for keyless ones in XCDR1, with a check in
 * front of what comes from the network, and quicker where a type has a plan. */
static struct ddsi_serdata_ops keyed_operations, keyless_operations;
static struct ddsi_sertype_ops type_operations;
static pthread_once_t operations_once = PTHREAD_ONCE_INIT;

static const struct ddsi_serdata_ops *behind_check(const struct ddsi_sertype *type)
{
    return type->typekind_no_key ? &ddsi_serdata_ops_cdr_nokey : &ddsi_serdata_ops_xcdr2;
}

/* Whether DDS may look at a sample: `size` bytes from the encapsulation header on. */
static bool may_pass(const struct ddsi_sertype *type, const uint8_t *data, size_t size)
{
    const struct ddsi_sertype_default *own = (const struct ddsi_sertype_default *)type;
    if (size < ENCAPSULATION || data[0] != 0)
        return false;
    /* each for a big machine; plus one for a little one. DDS takes plain XCDR2 where it is told of
     * XCDR1 */
    const uint8_t xcdr1 = 0, plain = 6, delimited = 8;
    const uint8_t representation = data[1] & 0xfe;
    if (type->typekind_no_key ? representation != xcdr1 && representation != plain
                              : representation != delimited)
        return false;
    /* DDS takes only this bit of the padding's size */
    size_t padding = data[3] & 2;
    bool swapped = (data[1] == representation) == (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    return size - ENCAPSULATION >= padding &&
           wire_whole_in(representation == xcdr1 ? 1 : 2, own->type.ops.ops, data + ENCAPSULATION,
                         size - ENCAPSULATION - padding, swapped);
}

static struct ddsi_serdata *take_bytes(const struct ddsi_sertype *type, void *data, size_t size)
{
    struct ddsi_serdata *sample = wire_sample_take((const struct wire_type *)type, data, size);
    wire_hand_give(sample);
    if (sample || !may_pass(type, data, size))
        return sample;
    ddsrt_iovec_t whole = {.iov_base = data, .iov_len = size};
    return behind_check(type)->from_ser_iov(type, SDK_DATA, 1, &whole, size);
}

static const unsigned char *fragment_data(const struct nn_rdata *fragment)
{
    return NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
}

/* A sample in several packets. They ascend and may overlap. */
static struct ddsi_serdata *take_fragments(const struct ddsi_sertype *type,
                                           const struct nn_rdata *first, size_t size)
{
    uint8_t *data = malloc(size);
    size_t filled = 0;
    for (const struct nn_rdata *part = first; data && part; part = part->nextfrag) {
        if (part->min > filled || part->maxp1 > size)
            break;
        if (part->maxp1 > filled)
            memcpy(data + filled, fragment_data(part) + filled - part->min, part->maxp1 - filled);
        filled = part->maxp1 > filled ? part->maxp1 : filled;
    }
    struct ddsi_serdata *sample = data ? take_bytes(type, data, filled) : NULL;
    free(data);
    return sample;
}

static struct ddsi_serdata *from_network(const struct ddsi_sertype *type,
                                         enum ddsi_serdata_kind kind,
                                         const struct nn_rdata *fragments, size_t size)
{
    if (fragments->maxp1 < ENCAPSULATION)
        return NULL;
    /* keys are octets and strings, and these are checked well */
    if (kind == SDK_DATA && fragments->nextfrag)
        return take_fragments(type, fragments, size);
    const uint8_t *data = fragment_data(fragments);
    struct ddsi_serdata *sample =
        kind == SDK_DATA ? wire_sample_take((const struct wire_type *)type, data, fragments->maxp1)
                         : NULL;
    wire_hand_give(sample);
    if (sample || (kind == SDK_DATA && !may_pass(type, data, fragments->maxp1)))
        return sample;
    return behind_check(type)->from_ser(type, kind, fragments, size);
}

/* What the security plugins have decrypted, and what comes from this process in another type. */
static struct ddsi_serdata *from_pieces(const struct ddsi_sertype *type,
                                        enum ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                                        const ddsrt_iovec_t *pieces, size_t size)
{
    if (kind != SDK_DATA)
        return behind_check(type)->from_ser_iov(type, kind, count, pieces, size);
    size_t filled = 0;
    uint8_t *data = malloc(size);
    for (size_t i = 0; data && i < (size_t)count && pieces[i].iov_len <= size - filled; i++) {
        memcpy(data + filled, pieces[i].iov_base, pieces[i].iov_len);
        filled += pieces[i].iov_len;
    }
    struct ddsi_serdata *sample = data ? take_bytes(type, data, filled) : NULL;
    free(data);
    return sample;
}

/* DDS asks whether a sample has these very operations of its own to see whether its type has a key.
 * So it is shown the sample's head, which is all that it looks at, with them. */
static struct ddsi_serdata *to_key(const struct ddsi_serdata *sample)
{
    union {
        struct ddsi_serdata common;
        uint8_t bytes[LARGEST_HEAD];
    } head;
    ddsrt_iovec_t header;
    wire_hand_take(sample);
    struct ddsi_serdata *held = ddsi_serdata_to_ser_ref(sample, 0, ENCAPSULATION, &header);
    size_t size = (size_t)((uint8_t *)header.iov_base - (const uint8_t *)sample) + ENCAPSULATION;
    if (size > sizeof head)
        abort();
    /* all but the count of those who hold it, which they change meanwhile */
    const size_t count = offsetof(struct ddsi_serdata, refc), rest = count + sizeof sample->refc;
    memcpy(&head, sample, count);
    ddsrt_atomic_st32(&head.common.refc, 1);
    memcpy(head.bytes + rest, (const uint8_t *)sample + rest, size - rest);
    wire_hand_give(sample);
    ddsi_serdata_to_ser_unref(held, &header);
    head.common.ops = behind_check(sample->type);
    return head.common.ops->to_untyped(&head.common);
}

static struct ddsi_serdata *from_sample(const struct ddsi_sertype *type,
                                        enum ddsi_serdata_kind kind, const void *sample)
{
    struct ddsi_serdata *written =
        wire_sample_write((const struct wire_type *)type, behind_check(type), kind, sample);
    wire_hand_give(written);
    return written;
}

static bool to_sample(const struct ddsi_serdata *taken, void *sample, void **buffer, void *limit)
{
    wire_hand_take(taken);
    bool read = wire_sample_read(taken, behind_check(taken->type), sample, buffer, limit);
    wire_hand_give(taken);
    return read;
}

/* What to_key has made has no type. All are given back alike. */
static void free_sample(struct ddsi_serdata *sample)
{
    wire_hand_take(sample);
    ddsi_serdata_ops_xcdr2.free(sample);
}

static void free_type(struct ddsi_sertype *type)
{
    wire_sample_forget((struct wire_type *)type);
    ddsi_sertype_ops_default.free(type);
}

static void put_ours(struct ddsi_serdata_ops *operations)
{
    operations->from_sample = from_sample;
    operations->to_sample = to_sample;
    operations->from_ser = from_network;
    operations->from_ser_iov = from_pieces;
    operations->to_untyped = to_key;
    operations->free = free_sample;
}

static void prepare_operations(void)
{
    keyed_operations = ddsi_serdata_ops_xcdr2;
    keyless_operations = ddsi_serdata_ops_cdr_nokey;
    put_ours(&keyed_operations);
    put_ours(&keyless_operations);
    type_operations = ddsi_sertype_ops_default;
    /* there is no other representation to derive a type for */
    type_operations.derive_sertype = NULL;
    type_operations.free = free_type;
}

/* What dds_create_topic makes of a descriptor, with our operations. */
static struct ddsi_sertype_default *create_type(const dds_topic_descriptor_t *descriptor)
{
    struct wire_type *whole = dds_alloc(sizeof *whole);
    memset(whole, 0, sizeof *whole);
    struct ddsi_sertype_default *type = &whole->common;
    const bool keyless = descriptor->m_nkeys == 0;
    ddsi_sertype_init(&type->c, descriptor->m_typename, &type_operations,
                      keyless ? &keyless_operations : &keyed_operations, keyless);
    /* written as delimited XCDR2 alone, or as XCDR1 */
    type->c.allowed_data_representation =
        keyless ? DDS_DATA_REPRESENTATION_RESTRICT_DEFAULT : DDS_DATA_REPRESENTATION_FLAG_XCDR2;
#ifdef DDS_HAS_SHM
    type->c.iox_size = descriptor->m_size;
#endif
    type->encoding_format = keyless ? CDR_ENC_FORMAT_PLAIN : CDR_ENC_FORMAT_DELIMITED;
    type->write_encoding_version = keyless ? CDR_ENC_VERSION_1 : CDR_ENC_VERSION_2;
    /* the sample in memory, and its keys */
    type->type.size = descriptor->m_size;
    type->type.align = descriptor->m_align;
    type->type.flagset = descriptor->m_flagset;
    type->type.keys.nkeys = descriptor->m_nkeys;
    type->type.keys.keys = dds_alloc(descriptor->m_nkeys * sizeof *type->type.keys.keys);
    for (uint32_t i = 0; i < descriptor->m_nkeys; i++)
        type->type.keys.keys[i] = (ddsi_sertype_default_desc_key_t){
            .ops_offs = descriptor->m_keys[i].m_offset, .idx = descriptor->m_keys[i].m_idx};
    /* the operations that write and read it */
    type->type.ops.nops =
        dds_stream_countops(descriptor->m_ops, descriptor->m_nkeys, descriptor->m_keys);
    size_t ops = type->type.ops.nops * sizeof *type->type.ops.ops;
    type->type.ops.ops = dds_alloc(ops);
    memcpy(type->type.ops.ops, descriptor->m_ops, ops);
    return type;
}

dds_entity_t wire_topic_create_typed(dds_entity_t participant,
                                     const dds_topic_descriptor_t *descriptor, const char *name,
                                     const struct ddsi_sertype **type)
{
    if ((descriptor->m_nkeys == 0) == (descriptor->m_ops[0] == DDS_OP_DLC))
        return DDS_RETCODE_BAD_PARAMETER;
    pthread_once(&operations_once, prepare_operations);
    /* registered with the domain, or exchanged for an equal one that is */
    struct ddsi_sertype *used = &create_type(descriptor)->c;
    dds_entity_t topic = dds_create_topic_sertype(participant, name, &used, NULL, NULL, NULL);
    if (topic < 0) {
        ddsi_sertype_unref(used);
        return topic;
    }
    /* only now is it known which domain's pool of samples it takes from */
    const struct ddsi_domaingv *domain = ddsrt_atomic_ldvoidp(&used->gv);
    __atomic_store_n(&((struct ddsi_sertype_default *)used)->serpool, domain->serpool,
                     __ATOMIC_RELEASE);
    wire_sample_prepare((struct wire_type *)used);
    if (type)
        *type = used;
    return topic;
}

dds_entity_t wire_topic_create(dds_entity_t participant, const dds_topic_descriptor_t *descriptor,
                               const char *name)
{
    return wire_topic_create_typed(participant, descriptor, name, NULL);
}
