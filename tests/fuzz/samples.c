/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "samples.h"

#include "wire_read.h"
#include "wire_whole.h"

/* As wire_sample.c: by the type's plan, where the bytes are complete. False: they are not. The copy
 * has the sample's size, so that tools see every byte read beyond it. */
static bool give_planned(int type, const char *copy, size_t size, samples_visit *visit,
                         void *context)
{
    static struct wire_plan *plans[ANY_TYPES]; /* kept for the whole run */
    const dds_topic_descriptor_t *descriptor = any_types[type].type;
    if (!plans[type])
        plans[type] = wire_plan_create(descriptor->m_ops);
    FUZZ_REQUIRE(plans[type], "no plan of a %s", any_types[type].topic);
    const uint8_t *data = (const uint8_t *)copy;
    if (!wire_read_is_complete(plans[type], data, size))
        return false;
    FUZZ_REQUIRE(wire_whole(descriptor->m_ops, data, size, false),
                 "the plan of a %s takes what the check refuses", any_types[type].topic);
    void *sample = dds_alloc(descriptor->m_size);
    memset(sample, 0, descriptor->m_size);
    FUZZ_REQUIRE(wire_read(plans[type], data, size, sample), "a complete %s is not read",
                 any_types[type].topic);
    visit(context, type, sample);
    dds_sample_free(sample, descriptor, DDS_FREE_ALL);
    return true;
}

/* As wire_topic.c and DDS behind it. */
static void give(int type, bool swapped, const struct fuzz_bytes *bytes, samples_visit *visit,
                 void *context)
{
    const dds_topic_descriptor_t *descriptor = any_types[type].type;
    uint32_t used = 0;
    char *copy = malloc(bytes->left + !bytes->left);
    if (bytes->left)
        memcpy(copy, bytes->data, bytes->left);
    const bool planned = !swapped && give_planned(type, copy, bytes->left, visit, context);
    if (!planned && wire_whole(descriptor->m_ops, copy, bytes->left, swapped) &&
        dds_stream_normalize_data(copy, &used, (uint32_t)bytes->left, swapped, XCDR2,
                                  descriptor->m_ops)) {
        void *sample = dds_alloc(descriptor->m_size);
        memset(sample, 0, descriptor->m_size);
        dds_istream_t stream;
        dds_istream_init(&stream, (uint32_t)bytes->left, copy, XCDR2);
        dds_stream_read(&stream, sample, descriptor->m_ops);
        FUZZ_REQUIRE(stream.m_index <= bytes->left, "DDS reads beyond a %s", any_types[type].topic);
        visit(context, type, sample);
        dds_sample_free(sample, descriptor, DDS_FREE_ALL);
    }
    free(copy);
}

void samples_give(const uint8_t *data, size_t size, uint32_t types, samples_visit *visit,
                  void *context)
{
    struct fuzz_bytes bytes = {data, size};
    while (bytes.left) {
        uint8_t head[4];
        fuzz_take(&bytes, head, sizeof head);
        int type = head[0] % ANY_TYPES;
        size_t length = head[2] + 256u * head[3];
        struct fuzz_bytes sample = {bytes.data, length < bytes.left ? length : bytes.left};
        bytes.data += sample.left;
        bytes.left -= sample.left;
        if (types >> type & 1)
            give(type, head[1] & 1, &sample, visit, context);
    }
}
