/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* idl/wire_whole.c: samples of every type, whole, cut and damaged, in both byte orders. What passes
 * is given to Cyclone DDS, which must not leave it; tests with a daemon are in tests/service. */
#include <string.h>

#include "any_sample.h"
#include "check.h"
#include "wire_whole.h"

/* More than the half of fifty numbers by which Cyclone DDS can run over our samples. */
enum { BEYOND = 4096, MARK = 0xa5 };

/* Copied to its exact size, so that tools see every byte read beyond it. */
static bool passes(const dds_topic_descriptor_t *type, const struct any_bytes *bytes, size_t size,
                   bool swapped)
{
    uint8_t *copy = malloc(size + !size);
    assert_non_null(copy);
    memcpy(copy, bytes->data, size);
    bool whole = wire_whole(type->m_ops, copy, size, swapped);
    free(copy);
    return whole;
}

/* Whether Cyclone DDS, given these bytes, changes any behind them. */
static bool runs_over(const dds_topic_descriptor_t *type, const struct any_bytes *bytes,
                      size_t size, bool swapped)
{
    char *room = malloc(size + BEYOND);
    assert_non_null(room);
    memcpy(room, bytes->data, size);
    memset(room + size, MARK, BEYOND);
    uint32_t used = 0;
    if (dds_stream_normalize_data(room, &used, (uint32_t)size, swapped, XCDR2, type->m_ops))
        assert_true(used <= size);
    bool over = false;
    for (size_t i = 0; i < BEYOND; i++)
        over = over || (uint8_t)room[size + i] != MARK;
    free(room);
    return over;
}

/* Cyclone DDS takes the bytes, and reads no further than they are. */
static void decodes(const dds_topic_descriptor_t *type, const struct any_bytes *bytes, size_t size,
                    bool swapped)
{
    char *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, bytes->data, size);
    uint32_t used = 0;
    if (dds_stream_normalize_data(copy, &used, (uint32_t)size, swapped, XCDR2, type->m_ops)) {
        void *sample = dds_alloc(type->m_size);
        memset(sample, 0, type->m_size);
        dds_istream_t stream;
        dds_istream_init(&stream, (uint32_t)size, copy, XCDR2);
        dds_stream_read(&stream, sample, type->m_ops);
        assert_true(stream.m_index <= size);
        dds_sample_free(sample, type, DDS_FREE_ALL);
    }
    free(copy);
}

static void whole_samples_pass(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * ANY_TYPES; i++) {
        const dds_topic_descriptor_t *type = any_types[i / 2].type;
        struct any_bytes bytes = any_sample(type, i % 2);
        assert_true(passes(type, &bytes, bytes.size, i % 2));
        decodes(type, &bytes, bytes.size, i % 2);
        free(bytes.data);
    }
}

/* As from a peer of an older version that ends anywhere: the size in front says so. */
static void cut_samples_pass_only_where_dds_stays_inside(void **state)
{
    (void)state;
    int passed = 0, unsafe = 0;
    for (int i = 0; i < 2 * ANY_TYPES; i++) {
        const dds_topic_descriptor_t *type = any_types[i / 2].type;
        bool swapped = i % 2;
        struct any_bytes bytes = any_sample(type, swapped);
        for (size_t size = 4; size < bytes.size; size++) {
            any_put(bytes.data, size - 4, swapped);
            bool over = runs_over(type, &bytes, size, swapped);
            unsafe += over;
            if (!passes(type, &bytes, size, swapped))
                continue;
            passed++;
            assert_false(over);
            decodes(type, &bytes, size, swapped);
        }
        free(bytes.data);
    }
    /* the first is the growth of types that peers rely on; with the second the check is in vain */
    assert_true(passed > 50);
    print_message("%d cut samples pass; of the others DDS would leave %d\n", passed, unsafe);
    assert_true(unsafe > 100);
}

/* Lengths and sizes of every kind, wherever they stand. */
static void damaged_samples_pass_only_where_dds_stays_inside(void **state)
{
    (void)state;
    static const uint32_t wrong[] = {0, 1, 5, 0x7fffffff, 0x80000001, 0xfffffff0, UINT32_MAX};
    int passed = 0;
    for (int i = 0; i < 2 * ANY_TYPES; i++) {
        const dds_topic_descriptor_t *type = any_types[i / 2].type;
        struct any_bytes bytes = any_sample(type, i % 2);
        for (size_t at = 0; at + 4 <= bytes.size; at += 4) {
            uint8_t kept[4];
            memcpy(kept, bytes.data + at, sizeof kept);
            for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
                any_put(bytes.data + at, wrong[k], i % 2);
                if (passes(type, &bytes, bytes.size, i % 2)) {
                    passed++;
                    assert_false(runs_over(type, &bytes, bytes.size, i % 2));
                    decodes(type, &bytes, bytes.size, i % 2);
                }
            }
            memcpy(bytes.data + at, kept, sizeof kept);
        }
        free(bytes.data);
    }
    assert_true(passed > 1000); /* most words are numbers */
}

/* A request may end before its last members, the server and that it is cancelled, but not before or
 * in its options. */
static void a_missing_struct_is_refused(void **state)
{
    (void)state;
    struct any_bytes bytes = any_sample(&percuss_v1_Request_desc, false);
    size_t whole = bytes.size, server = 16 + 1;
    any_put(bytes.data, whole - server - 4, false);
    assert_true(passes(&percuss_v1_Request_desc, &bytes, whole - server, false));
    for (size_t size = 4; size < whole - server; size++) {
        any_put(bytes.data, size - 4, false);
        assert_false(passes(&percuss_v1_Request_desc, &bytes, size, false));
    }
    free(bytes.data);
}

static void more_elements_than_the_bound_are_refused(void **state)
{
    (void)state;
    static uint8_t data[8192];
    struct any_bytes bytes = {data, sizeof data};
    /* a batch: client, sequence, then requests of no bytes each, which a bound of 256 forbids
     * anyway */
    any_put(data, sizeof data - 4, false);
    any_put(data + 28, sizeof data - 32, false);
    any_put(data + 32, 2000, false);
    assert_false(passes(&percuss_v1_BatchRequest_desc, &bytes, bytes.size, false));
}

/* Elements that have left out all their members, 4 bytes each. */
static void a_list_that_would_swell_is_refused(void **state)
{
    (void)state;
    const size_t before = 44, room = (64 << 20) / sizeof(percuss_v1_Dent);
    struct any_bytes bytes = {calloc(1, before + 4 * (room + 1)), before + 4 * (room + 1)};
    assert_non_null(bytes.data);
    /* specimen and body, empty, around the server; then the size of the list and how many */
    any_put(bytes.data + 4, 1, false);
    any_put(bytes.data + 28, 1, false);
    for (size_t count = room; count <= room + 1; count++) {
        size_t size = before + 4 * count;
        any_put(bytes.data, size - 4, false);
        any_put(bytes.data + 36, size - 40, false);
        any_put(bytes.data + 40, count, false);
        assert_int_equal(passes(&percuss_v1_Dents_desc, &bytes, size, false), count == room);
    }
    free(bytes.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_samples_pass),
        cmocka_unit_test(cut_samples_pass_only_where_dds_stays_inside),
        cmocka_unit_test(damaged_samples_pass_only_where_dds_stays_inside),
        cmocka_unit_test(a_missing_struct_is_refused),
        cmocka_unit_test(more_elements_than_the_bound_are_refused),
        cmocka_unit_test(a_list_that_would_swell_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
