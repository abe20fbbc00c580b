/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* idl/wire_topic.c: what its types take from the network, in a domain of its own on loopback. */
#include <dds/ddsi/ddsi_serdata.h>
#include <pthread.h>
#include <string.h>

#include "any_sample.h"
#include "check.h"
#include "domain.h"
#include "percuss_msgs.h"
#include "wire_topic.h"

static dds_entity_t participant;

static int open_domain(void **state)
{
    (void)state;
    participant = wire_participant_create(domain_draw());
    return participant < 0;
}

static int close_domain(void **state)
{
    (void)state;
    return dds_delete(dds_get_parent(participant)) != DDS_RETCODE_OK;
}

static struct ddsi_serdata *take(const struct ddsi_sertype *type, const struct any_bytes *bytes,
                                 size_t size, bool swapped)
{
    bool big = swapped == (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    uint8_t header[4] = {0, big ? 8 : 9, 0, 0};
    uint8_t *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, bytes->data, size);
    ddsrt_iovec_t pieces[2] = {{header, sizeof header}, {copy, size}};
    struct ddsi_serdata *sample =
        ddsi_serdata_from_ser_iov(type, SDK_DATA, 2, pieces, sizeof header + size);
    free(copy);
    return sample;
}

static const struct ddsi_sertype *type_of(int which)
{
    const struct ddsi_sertype *type = NULL;
    assert_true(wire_topic_create_typed(participant, any_types[which].type, any_types[which].topic,
                                        &type) > 0);
    return type;
}

static void whole_samples_are_taken_and_cut_ones_are_not(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * ANY_TYPES; i++) {
        const struct ddsi_sertype *type = type_of(i / 2);
        struct any_bytes bytes = any_sample(any_types[i / 2].type, i % 2);
        struct ddsi_serdata *sample = take(type, &bytes, bytes.size, i % 2);
        assert_non_null(sample);
        ddsi_serdata_unref(sample);
        /* the size in front says more than there is */
        for (size_t size = 4; size < bytes.size; size++)
            assert_null(take(type, &bytes, size, i % 2));
        free(bytes.data);
    }
}

/* What ended the daemon: its last number is where the sample ends, and half of its list is missing.
 */
static void a_request_with_half_of_its_delassus_is_dropped(void **state)
{
    (void)state;
    static uint8_t data[1100];
    struct any_bytes bytes = {data, sizeof data};
    const struct ddsi_sertype *type = type_of(0);
    for (int swapped = 0; swapped < 2; swapped++) {
        const size_t delassus =
            4 + 16 + 8 + 8 + 8; /* after client, sequence, no bodies, no contacts */
        const size_t count = (sizeof data - delassus - 4) / 4;
        any_put(data, sizeof data - 4, swapped);
        any_put(data + 28, 4, swapped);
        any_put(data + 36, 4, swapped);
        any_put(data + delassus, count, swapped);
        assert_null(take(type, &bytes, sizeof data, swapped));
    }
}

static void headers_of_other_representations_are_dropped(void **state)
{
    (void)state;
    const struct ddsi_sertype *type = type_of(0);
    struct any_bytes bytes = any_sample(any_types[0].type, false);
    for (int first = 0; first < 2; first++)
        for (int second = 0; second < 256; second++) {
            uint8_t header[4] = {(uint8_t)first, (uint8_t)second, 0, 0};
            ddsrt_iovec_t pieces[2] = {{header, sizeof header}, {bytes.data, bytes.size}};
            struct ddsi_serdata *sample =
                ddsi_serdata_from_ser_iov(type, SDK_DATA, 2, pieces, sizeof header + bytes.size);
            bool ours = first == 0 && second == (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? 9 : 8);
            assert_int_equal(sample != NULL, ours);
            if (sample)
                ddsi_serdata_unref(sample);
        }
    for (size_t size = 0; size < 4; size++) {
        ddsrt_iovec_t piece = {bytes.data, size};
        assert_null(ddsi_serdata_from_ser_iov(type, SDK_DATA, 1, &piece, size));
    }
    free(bytes.data);
}

/* The key is kept apart from the samples: it must be there when a sample has none. */
static void a_disposed_instance_keeps_its_key(void **state)
{
    (void)state;
    dds_entity_t topic = wire_topic_create(participant, &percuss_v1_Body_desc, WIRE_TOPIC_BODY);
    dds_entity_t reader = dds_create_reader(participant, topic, NULL, NULL);
    dds_entity_t writer = dds_create_writer(participant, topic, NULL, NULL);
    assert_true(reader > 0 && writer > 0);
    for (int i = 0; i < 2; i++) {
        percuss_v1_Body body = {.mass = i};
        strcpy(body.id, i ? "rod" : "sphere");
        assert_int_equal(dds_write(writer, &body), DDS_RETCODE_OK);
    }
    percuss_v1_Body gone = {.id = "sphere"};
    assert_int_equal(dds_dispose(writer, &gone), DDS_RETCODE_OK);
    void *samples[4] = {NULL};
    dds_sample_info_t infos[4];
    assert_int_equal(dds_take(reader, samples, infos, 4, 4), 2);
    for (int i = 0; i < 2; i++) {
        const percuss_v1_Body *body = samples[i];
        bool disposed = infos[i].instance_state == DDS_IST_NOT_ALIVE_DISPOSED;
        assert_string_equal(body->id, disposed ? "sphere" : "rod");
    }
    dds_return_loan(reader, samples, 2);
}

/* What ended the bridge of ROS 2: a sample that says XCDR2, and ends in half of its list. */
static void a_question_of_ros_with_half_of_its_delassus_is_dropped(void **state)
{
    (void)state;
    static uint8_t data[4 + 1100];
    const dds_topic_descriptor_t *descriptor = &percuss_msgs_msg_dds__Request__desc;
    const struct ddsi_sertype *type = NULL;
    assert_true(wire_topic_create_typed(participant, descriptor, "rt/request", &type) > 0);
    for (int swapped = 0; swapped < 2; swapped++) {
        /* after client, number, no bodies and no contacts, each with its size */
        const size_t delassus = 4 + 16 + 8 + 8 + 8;
        bool big = swapped == (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
        data[1] = big ? 6 : 7;
        any_put(data + 4 + 16 + 8, 4, swapped);
        any_put(data + 4 + 16 + 8 + 8, 4, swapped);
        any_put(data + delassus, (sizeof data - delassus - 4) / 4, swapped);
        ddsrt_iovec_t piece = {data, sizeof data};
        assert_null(ddsi_serdata_from_ser_iov(type, SDK_DATA, 1, &piece, sizeof data));
    }
}

/* Both versions, plain, as DDS takes them itself. */
static void headers_of_questions_of_ros(void **state)
{
    (void)state;
    const dds_topic_descriptor_t *descriptor = &percuss_msgs_srv_dds__Impact_Request__desc;
    const struct ddsi_sertype *type = NULL;
    assert_true(wire_topic_create_typed(participant, descriptor, "rq/impact", &type) > 0);
    void *sample = dds_alloc(descriptor->m_size);
    memset(sample, 0, descriptor->m_size);
    any_fill_struct(descriptor->m_ops, sample);
    for (uint32_t version = XCDR1; version <= XCDR2; version++) {
        struct any_bytes bytes = any_bytes_in(version, sample, descriptor->m_ops, false);
        const int little = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
        for (int second = 0; second < 256; second++) {
            uint8_t header[4] = {0, (uint8_t)second, 0, 0};
            ddsrt_iovec_t pieces[2] = {{header, sizeof header}, {bytes.data, bytes.size}};
            struct ddsi_serdata *taken =
                ddsi_serdata_from_ser_iov(type, SDK_DATA, 2, pieces, sizeof header + bytes.size);
            assert_int_equal(taken != NULL, second == (version == XCDR1 ? 0 : 6) + little);
            if (taken)
                ddsi_serdata_unref(taken);
        }
        free(bytes.data);
    }
    dds_sample_free(sample, descriptor, DDS_FREE_ALL);
}

/* What is written by a plan, or by DDS where there is none, is what is read of the bytes of DDS. */
static void what_is_written_is_what_dds_reads(void **state)
{
    (void)state;
    for (int i = 0; i < ANY_TYPES; i++) {
        const dds_topic_descriptor_t *descriptor = any_types[i].type;
        const struct ddsi_sertype *type = type_of(i);
        void *sample = dds_alloc(descriptor->m_size);
        memset(sample, 0, descriptor->m_size);
        any_fill_struct(descriptor->m_ops, sample);
        struct any_bytes bytes = any_bytes_of(sample, descriptor->m_ops, false);
        struct ddsi_serdata *read = take(type, &bytes, bytes.size, false);
        struct ddsi_serdata *written = ddsi_serdata_from_sample(type, SDK_DATA, sample);
        assert_non_null(written);
        assert_true(ddsi_serdata_eqkey(written, read));
        assert_int_equal(written->hash, read->hash);
        ddsi_keyhash_t keys[2];
        ddsi_serdata_get_keyhash(written, &keys[0], false);
        ddsi_serdata_get_keyhash(read, &keys[1], false);
        assert_memory_equal(&keys[0], &keys[1], sizeof keys[0]);
        /* the header tells of the zeros behind, which bring it to a multiple of 4 */
        const size_t padding = (4 - bytes.size % 4) % 4, size = 4 + bytes.size + padding;
        assert_int_equal(ddsi_serdata_size(written), size);
        uint8_t *whole = malloc(size);
        assert_non_null(whole);
        ddsi_serdata_to_ser(written, 0, size, whole);
        assert_int_equal(whole[1], __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? 9 : 8);
        assert_int_equal(whole[3], padding);
        assert_memory_equal(whole + 4, bytes.data, bytes.size);
        free(whole);
        free(bytes.data);
        ddsi_serdata_unref(written);
        ddsi_serdata_unref(read);
        dds_sample_free(sample, descriptor, DDS_FREE_ALL);
    }
}

enum { HOLDS = 2000 };

static void *hold_and_let_go(void *sample)
{
    for (int i = 0; i < HOLDS; i++)
        ddsi_serdata_unref(ddsi_serdata_ref(sample));
    return NULL;
}

/* Who asks for the key is not the only one who holds a sample: the thread sanitizer watches. */
static void the_key_of_a_sample_that_others_hold(void **state)
{
    (void)state;
    const struct ddsi_sertype *type = type_of(0);
    struct any_bytes bytes = any_sample(any_types[0].type, false);
    struct ddsi_serdata *sample = take(type, &bytes, bytes.size, false);
    struct ddsi_serdata *first = ddsi_serdata_to_untyped(sample);
    pthread_t other;
    assert_int_equal(pthread_create(&other, NULL, hold_and_let_go, sample), 0);
    for (int i = 0; i < HOLDS; i++) {
        struct ddsi_serdata *key = ddsi_serdata_to_untyped(sample);
        assert_true(ddsi_serdata_eqkey(key, first));
        assert_int_equal(key->hash, sample->hash);
        ddsi_serdata_unref(key);
    }
    assert_int_equal(pthread_join(other, NULL), 0);
    assert_int_equal(ddsrt_atomic_ld32(&sample->refc), 1);
    ddsi_serdata_unref(first);
    ddsi_serdata_unref(sample);
    free(bytes.data);
}

static void types_without_a_size_in_front_are_refused(void **state)
{
    (void)state;
    static const uint32_t ops[] = {DDS_OP_RTS};
    dds_topic_descriptor_t descriptor = percuss_v1_Body_desc;
    descriptor.m_ops = ops;
    assert_true(wire_topic_create(participant, &descriptor, "final") == DDS_RETCODE_BAD_PARAMETER);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_samples_are_taken_and_cut_ones_are_not),
        cmocka_unit_test(a_request_with_half_of_its_delassus_is_dropped),
        cmocka_unit_test(headers_of_other_representations_are_dropped),
        cmocka_unit_test(a_disposed_instance_keeps_its_key),
        cmocka_unit_test(a_question_of_ros_with_half_of_its_delassus_is_dropped),
        cmocka_unit_test(headers_of_questions_of_ros),
        cmocka_unit_test(what_is_written_is_what_dds_reads),
        cmocka_unit_test(the_key_of_a_sample_that_others_hold),
        cmocka_unit_test(types_without_a_size_in_front_are_refused),
    };
    return cmocka_run_group_tests(tests, open_domain, close_domain);
}
