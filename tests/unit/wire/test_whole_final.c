/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* idl/wire_whole.c: the types of ROS 2, which are @final and have no key, in both versions of XCDR
 * and both byte orders. What passes is given to Cyclone DDS, which must not leave it. */
#include <string.h>

#include "any_sample.h"
#include "check.h"
#include "percuss_msgs.h"
#include "wire_whole.h"

/* More than the half of fifty numbers by which Cyclone DDS can run over our samples. */
enum { BEYOND = 4096, MARK = 0xa5, WAYS = 4 };

static const dds_topic_descriptor_t *const types[] = {
    &percuss_msgs_msg_dds__Request__desc, &percuss_msgs_srv_dds__Impact_Request__desc,
    &percuss_msgs_msg_dds__Reply__desc, &percuss_msgs_msg_dds__BodyList__desc};
enum { TYPES = sizeof types / sizeof *types };

/* A way to write them. */
static uint32_t version_of(int way)
{
    return way / 2 ? XCDR2 : XCDR1;
}

static struct any_bytes make(const dds_topic_descriptor_t *type, int way)
{
    void *sample = dds_alloc(type->m_size);
    memset(sample, 0, type->m_size);
    any_fill_struct(type->m_ops, sample);
    struct any_bytes bytes = any_bytes_in(version_of(way), sample, type->m_ops, way % 2);
    dds_sample_free(sample, type, DDS_FREE_ALL);
    return bytes;
}

/* Copied to its exact size, so that tools see every byte read beyond it. */
static bool passes(const dds_topic_descriptor_t *type, const struct any_bytes *bytes, size_t size,
                   int way)
{
    uint8_t *copy = malloc(size + !size);
    assert_non_null(copy);
    memcpy(copy, bytes->data, size);
    bool whole = wire_whole_in((int)version_of(way), type->m_ops, copy, size, way % 2);
    free(copy);
    return whole;
}

/* Whether Cyclone DDS takes these bytes (then it has read no further), and whether it has changed
 * any behind them. */
struct taken {
    bool whole, over;
};

static struct taken give(const dds_topic_descriptor_t *type, const struct any_bytes *bytes,
                         size_t size, int way)
{
    struct taken taken = {false, false};
    char *room = malloc(size + BEYOND);
    assert_non_null(room);
    memcpy(room, bytes->data, size);
    memset(room + size, MARK, BEYOND);
    uint32_t used = 0;
    if (dds_stream_normalize_data(room, &used, (uint32_t)size, way % 2, version_of(way),
                                  type->m_ops))
        taken.whole = used <= size;
    for (size_t i = 0; i < BEYOND; i++)
        taken.over = taken.over || (uint8_t)room[size + i] != MARK;
    if (taken.whole) {
        void *sample = dds_alloc(type->m_size);
        memset(sample, 0, type->m_size);
        dds_istream_t stream;
        dds_istream_init(&stream, (uint32_t)size, room, version_of(way));
        dds_stream_read(&stream, sample, type->m_ops);
        assert_true(stream.m_index <= size);
        dds_sample_free(sample, type, DDS_FREE_ALL);
    }
    free(room);
    return taken;
}

static void whole_samples_pass_and_cut_ones_do_not(void **state)
{
    (void)state;
    int unsafe[3] = {0};
    for (int i = 0; i < WAYS * TYPES; i++) {
        const dds_topic_descriptor_t *type = types[i / WAYS];
        const int way = i % WAYS;
        struct any_bytes bytes = make(type, way);
        assert_true(passes(type, &bytes, bytes.size, way));
        assert_true(give(type, &bytes, bytes.size, way).whole);
        for (size_t size = 0; size < bytes.size; size++) {
            assert_false(passes(type, &bytes, size, way));
            unsafe[version_of(way)] += give(type, &bytes, size, way).over;
        }
        free(bytes.data);
    }
    /* without the check, a peer that says XCDR2 where the type is XCDR1's writes beyond a sample */
    assert_int_equal(unsafe[XCDR1], 0);
    assert_true(unsafe[XCDR2] > 50);
}

/* Lengths and sizes of every kind, wherever they stand: the check lets pass what Cyclone DDS takes
 * in XCDR1, where it is right, and what it takes in XCDR2 without leaving the sample. */
static void damaged_samples_pass_where_dds_takes_them(void **state)
{
    (void)state;
    static const uint32_t wrong[] = {0, 1, 5, 0x7fffffff, 0x80000001, 0xfffffff0, UINT32_MAX};
    int passed = 0;
    for (int i = 0; i < WAYS * TYPES; i++) {
        const dds_topic_descriptor_t *type = types[i / WAYS];
        const int way = i % WAYS;
        struct any_bytes bytes = make(type, way);
        for (size_t at = 0; at + 4 <= bytes.size; at += 4) {
            uint8_t kept[4];
            memcpy(kept, bytes.data + at, sizeof kept);
            for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
                any_put(bytes.data + at, wrong[k], way % 2);
                bool pass = passes(type, &bytes, bytes.size, way);
                if (pass)
                    assert_false(give(type, &bytes, bytes.size, way).over);
                else if (version_of(way) == XCDR1)
                    assert_false(give(type, &bytes, bytes.size, way).whole);
                passed += pass;
            }
            memcpy(bytes.data + at, kept, sizeof kept);
        }
        free(bytes.data);
    }
    assert_true(passed > 1000); /* most words are numbers */
}

/* Those have a size in front, which XCDR1 does not know. */
static void appendable_types_are_refused_in_xcdr1(void **state)
{
    (void)state;
    for (int i = 0; i < ANY_TYPES; i++) {
        struct any_bytes bytes = any_sample(any_types[i].type, false);
        assert_true(wire_whole_in(2, any_types[i].type->m_ops, bytes.data, bytes.size, false));
        assert_false(wire_whole_in(1, any_types[i].type->m_ops, bytes.data, bytes.size, false));
        free(bytes.data);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_samples_pass_and_cut_ones_do_not),
        cmocka_unit_test(damaged_samples_pass_where_dds_takes_them),
        cmocka_unit_test(appendable_types_are_refused_in_xcdr1),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
