/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A peer of ROS 2 that means harm: it writes questions to percuss-ros2 that are cut anywhere or
 * changed, on the topic and to the service, in both versions of XCDR and both byte orders, past the
 * writing half of DDS which would not make such. usage: ros2_damaged DOMAIN COUNT */
#include <dds/ddsi/ddsi_serdata_default.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"
#include "percuss_msgs.h"
#include "unit/wire/any_sample.h"

enum { HEADER = 4, PACE = 500000 /* ns between samples */, LARGEST = 1 << 16 };

struct target {
    const dds_topic_descriptor_t *type;
    dds_entity_t writer;
    /* the type as DDS has it: that of a whole sample that it has made */
    struct ddsi_serdata *whole;
};

static void *make_sample(const dds_topic_descriptor_t *type)
{
    void *sample = dds_alloc(type->m_size);
    memset(sample, 0, type->m_size);
    any_fill_struct(type->m_ops, sample);
    return sample;
}

/* What DDS makes of a sample, by a topic that nobody else reads. */
static struct ddsi_serdata *whole_of(dds_entity_t participant, const dds_topic_descriptor_t *type)
{
    struct ddsi_serdata *made = NULL;
    dds_sample_info_t info;
    dds_entity_t topic = dds_create_topic(participant, type, "own", NULL, NULL);
    dds_entity_t reader = dds_create_reader(participant, topic, NULL, NULL);
    dds_entity_t writer = dds_create_writer(participant, topic, NULL, NULL);
    void *sample = make_sample(type);
    REQUIRE(dds_write(writer, sample) == DDS_RETCODE_OK &&
                dds_takecdr(reader, &made, 1, &info, DDS_ANY_STATE) == 1,
            "DDS takes no sample");
    dds_sample_free(sample, type, DDS_FREE_ALL);
    dds_delete(writer);
    dds_delete(reader);
    return made;
}

static struct target open_target(dds_entity_t participant, const dds_topic_descriptor_t *type,
                                 const char *name)
{
    dds_qos_t *qos = wire_qos_exchange(NULL);
    dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
    struct target target = {.type = type,
                            .writer = dds_create_writer(participant, topic, qos, NULL)};
    dds_delete_qos(qos);
    dds_instance_handle_t other;
    for (double end = peer_now() + 20.0;
         dds_get_matched_subscriptions(target.writer, &other, 1) < 1;) {
        REQUIRE(peer_now() < end, "no bridge");
        dds_sleepfor(DDS_MSECS(2));
    }
    target.whole = whole_of(participant, type);
    return target;
}

static void damage(struct any_bytes *bytes, bool swapped)
{
    static const uint32_t wrong[] = {0, 1, 3, 128, 0x7fffffff, 0x80000001, UINT32_MAX};
    if (any_number() % 2)
        any_put(bytes->data + any_number() % (bytes->size / 4) * 4,
                wrong[any_number() % (sizeof wrong / sizeof *wrong)], swapped);
    if (any_number() % 2)
        bytes->size = any_number() % bytes->size;
}

/* A sample of this size, made by DDS of one that is good in front, gets these bytes. */
static void attack(const struct target *target)
{
    static uint8_t room[LARGEST];
    const bool swapped = any_number() % 2;
    const bool second = any_number() % 2;
    const bool big = swapped == (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    void *sample = make_sample(target->type);
    struct any_bytes bytes =
        any_bytes_in(second ? XCDR2 : XCDR1, sample, target->type->m_ops, swapped);
    dds_sample_free(sample, target->type, DDS_FREE_ALL);
    damage(&bytes, swapped);
    /* DDS looks at no more than the question; behind it there is room */
    uint32_t size = ddsi_serdata_size(target->whole);
    REQUIRE(size + bytes.size < sizeof room, "a question of %u bytes", size);
    memset(room, 0, size + bytes.size);
    ddsi_serdata_to_ser(target->whole, 0, size, room);
    ddsrt_iovec_t all = {room, size + bytes.size};
    struct ddsi_serdata *damaged =
        ddsi_serdata_from_ser_iov(target->whole->type, SDK_DATA, 1, &all, all.iov_len);
    REQUIRE(damaged, "a good question is refused");
    ddsrt_iovec_t inside;
    struct ddsi_serdata *held = ddsi_serdata_to_ser_ref(damaged, 0, HEADER, &inside);
    uint8_t *data = inside.iov_base;
    data[1] = (uint8_t)((second ? 6 : 0) + !big);
    memcpy(data + HEADER, bytes.data, bytes.size);
    ((struct ddsi_serdata_default *)damaged)->pos = (uint32_t)bytes.size;
    ddsi_serdata_to_ser_unref(held, &inside);
    /* gives the sample away */
    dds_writecdr(target->writer, damaged);
    free(bytes.data);
    dds_sleepfor(PACE);
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: ros2_damaged DOMAIN COUNT\n");
        return 2;
    }
    dds_entity_t participant = wire_participant_create((uint32_t)strtoul(argv[1], NULL, 10));
    REQUIRE(participant > 0, "no participant");
    struct target targets[2] = {
        open_target(participant, &percuss_msgs_msg_dds__Request__desc, "rt/percuss/request"),
        open_target(participant, &percuss_msgs_srv_dds__Impact_Request__desc,
                    "rq/percuss/impactRequest")};
    unsigned long count = strtoul(argv[2], NULL, 10);
    for (unsigned long i = 0; i < count; i++)
        attack(&targets[any_number() % 2]);
    /* what is on its way arrives */
    dds_sleepfor(DDS_MSECS(300));
    for (int i = 0; i < 2; i++)
        ddsi_serdata_unref(targets[i].whole);
    dds_delete(dds_get_parent(participant));
    printf("%lu damaged questions written\n", count);
    return EXIT_SUCCESS;
}
