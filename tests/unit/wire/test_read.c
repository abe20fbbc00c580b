/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* idl/wire_read.c: samples of every type, whole, cut and damaged, against Cyclone DDS behind
 * wire_whole.c. */
#include "wire_read.h"

#include "any_sample.h"
#include "check.h"
#include "wire_whole.h"

enum { DRAWS = 20 };

static struct wire_plan *plans[ANY_TYPES];

static int make_plans(void **state)
{
    (void)state;
    for (int i = 0; i < ANY_TYPES; i++) {
        plans[i] = wire_plan_create(any_types[i].type->m_ops);
        assert_non_null(plans[i]);
    }
    return 0;
}

static int drop_plans(void **state)
{
    (void)state;
    for (int i = 0; i < ANY_TYPES; i++)
        wire_plan_free(plans[i]);
    return 0;
}

/* Of their exact size, so that tools see every byte read beyond them. */
static uint8_t *exactly(const struct any_bytes *bytes, size_t size)
{
    uint8_t *copy = malloc(size + !size);
    assert_non_null(copy);
    memcpy(copy, bytes->data, size);
    return copy;
}

static void *zeroed(const dds_topic_descriptor_t *type)
{
    void *sample = dds_alloc(type->m_size);
    memset(sample, 0, type->m_size);
    return sample;
}

/* The sample's bytes as DDS writes them. */
static void assert_written_as(const dds_topic_descriptor_t *type, const void *sample,
                              const struct any_bytes *expected)
{
    struct any_bytes written = any_bytes_of(sample, type->m_ops, false);
    assert_int_equal(written.size, expected->size);
    assert_memory_equal(written.data, expected->data, written.size);
    free(written.data);
}

/* One after the other into the same memory, with lists now longer and now shorter. */
static void what_is_read_is_what_was_written(void **state)
{
    (void)state;
    for (int which = 0; which < ANY_TYPES; which++) {
        const dds_topic_descriptor_t *type = any_types[which].type;
        void *sample = zeroed(type);
        for (int i = 0; i < DRAWS; i++) {
            struct any_bytes bytes = any_sample(type, false);
            uint8_t *copy = exactly(&bytes, bytes.size);
            assert_true(wire_read_is_complete(plans[which], copy, bytes.size));
            assert_true(wire_read(plans[which], copy, bytes.size, sample));
            free(copy);
            assert_written_as(type, sample, &bytes);
            free(bytes.data);
        }
        dds_sample_free(sample, type, DDS_FREE_ALL);
    }
}

/* Complete ones DDS takes, and reads the same; of others nothing is left that cannot be freed. */
static bool agrees(int which, const struct any_bytes *bytes, size_t size)
{
    const dds_topic_descriptor_t *type = any_types[which].type;
    uint8_t *copy = exactly(bytes, size);
    void *sample = zeroed(type);
    bool complete = wire_read_is_complete(plans[which], copy, size);
    assert_int_equal(wire_read(plans[which], copy, size, sample), complete);
    if (complete) {
        uint32_t used = 0;
        assert_true(wire_whole(type->m_ops, copy, size, false));
        assert_non_null(dds_stream_normalize_data((char *)copy, &used, (uint32_t)size, false, XCDR2,
                                                  type->m_ops));
        void *other = zeroed(type);
        dds_istream_t stream;
        dds_istream_init(&stream, (uint32_t)size, copy, XCDR2);
        dds_stream_read(&stream, other, type->m_ops);
        struct any_bytes expected = any_bytes_of(other, type->m_ops, false);
        assert_written_as(type, sample, &expected);
        free(expected.data);
        dds_sample_free(other, type, DDS_FREE_ALL);
    }
    dds_sample_free(sample, type, DDS_FREE_ALL);
    free(copy);
    return complete;
}

/* As from a peer of an older version: the size in front says so. */
static void cut_samples_are_not_complete(void **state)
{
    (void)state;
    for (int i = 0; i < ANY_TYPES; i++) {
        struct any_bytes bytes = any_sample(any_types[i].type, false);
        for (size_t size = 4; size < bytes.size; size++) {
            any_put(bytes.data, size - 4, false);
            assert_false(agrees(i, &bytes, size));
            /* nor where the size says more than there is */
            any_put(bytes.data, bytes.size - 4, false);
            assert_false(agrees(i, &bytes, size));
        }
        free(bytes.data);
    }
}

/* From a newer version: what it has appended is passed over. */
static void members_that_are_not_known_are_passed_over(void **state)
{
    (void)state;
    for (int i = 0; i < ANY_TYPES; i++) {
        struct any_bytes bytes = any_sample(any_types[i].type, false);
        bytes.data = realloc(bytes.data, bytes.size + 12);
        assert_non_null(bytes.data);
        memset(bytes.data + bytes.size, 0xff, 12);
        any_put(bytes.data, bytes.size + 12 - 4, false);
        assert_true(agrees(i, &bytes, bytes.size + 12));
        free(bytes.data);
    }
}

/* Lengths, sizes, booleans and ends of texts, wherever they stand. */
static void damaged_samples_are_taken_as_dds_takes_them(void **state)
{
    (void)state;
    static const uint32_t wrong[] = {0, 1, 5, 0x00000200, 0x7fffffff, 0x80000001, UINT32_MAX};
    int taken = 0, refused = 0;
    for (int i = 0; i < ANY_TYPES; i++) {
        struct any_bytes bytes = any_sample(any_types[i].type, false);
        /* in threes, so that every place within a number is hit somewhere */
        for (size_t at = 0; at + 4 <= bytes.size; at += 3) {
            uint8_t kept[4];
            memcpy(kept, bytes.data + at, sizeof kept);
            for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
                any_put(bytes.data + at, wrong[k], false);
                bool good = agrees(i, &bytes, bytes.size);
                taken += good;
                refused += !good;
            }
            memcpy(bytes.data + at, kept, sizeof kept);
        }
        free(bytes.data);
    }
    assert_true(taken > 1000);
    assert_true(refused > 1000);
}

/* A list that is somebody else's and too short is left to DDS. */
static void lists_of_others_are_not_replaced(void **state)
{
    (void)state;
    double numbers[3] = {1.0, 2.0, 3.0}, room[2] = {0.0};
    percuss_v1_Request request = {.delassus = {._buffer = numbers, ._length = 3, ._maximum = 3}};
    struct any_bytes bytes = any_bytes_of(&request, percuss_v1_Request_desc.m_ops, false);
    percuss_v1_Request read = {.delassus = {._buffer = room, ._maximum = 2}};
    assert_false(wire_read(plans[0], bytes.data, bytes.size, &read));
    assert_ptr_equal(read.delassus._buffer, room);
    free(bytes.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_read_is_what_was_written),
        cmocka_unit_test(cut_samples_are_not_complete),
        cmocka_unit_test(members_that_are_not_known_are_passed_over),
        cmocka_unit_test(damaged_samples_are_taken_as_dds_takes_them),
        cmocka_unit_test(lists_of_others_are_not_replaced),
    };
    return cmocka_run_group_tests(tests, make_plans, drop_plans);
}
