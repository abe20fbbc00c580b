/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* idl/wire_write.c and wire_plan.c: the bytes of samples of every type, against those that Cyclone
 * DDS writes. */
#include "wire_write.h"

#include <dds/ddsrt/heap.h>

#include "any_sample.h"
#include "check.h"

/* Of each type, drawn anew: lists of other lengths, texts of others. */
enum { DRAWS = 20 };

static void *draw(const dds_topic_descriptor_t *type)
{
    void *sample = dds_alloc(type->m_size);
    memset(sample, 0, type->m_size);
    any_fill_struct(type->m_ops, sample);
    return sample;
}

/* Behind a head of seven bytes, which alignment must not count. */
static struct wire_block empty_block(size_t room)
{
    struct wire_block block = {.head = 7, .room = room};
    block.memory = ddsrt_malloc(block.head + block.room);
    memset(block.memory, 0xa5, block.head + block.room);
    return block;
}

static bool writes(const dds_topic_descriptor_t *type, const void *sample, struct wire_block *block,
                   size_t *padding)
{
    struct wire_plan *plan = wire_plan_create(type->m_ops);
    assert_non_null(plan);
    bool good = wire_write(plan, sample, block, padding);
    wire_plan_free(plan);
    return good;
}

static void the_bytes_are_those_of_dds(void **state)
{
    (void)state;
    for (int i = 0; i < DRAWS * ANY_TYPES; i++) {
        const dds_topic_descriptor_t *type = any_types[i % ANY_TYPES].type;
        void *sample = draw(type);
        struct any_bytes expected = any_bytes_of(sample, type->m_ops, false);
        struct wire_block block = empty_block((size_t)i);
        size_t padding;
        assert_true(writes(type, sample, &block, &padding));
        assert_int_equal(block.size, expected.size + padding);
        assert_int_equal(block.size, (expected.size + 3) / 4 * 4);
        assert_memory_equal(block.memory + block.head, expected.data, expected.size);
        for (size_t at = expected.size; at < block.size; at++)
            assert_int_equal(block.memory[block.head + at], 0);
        for (size_t at = 0; at < block.head; at++)
            assert_int_equal(block.memory[at], 0xa5);
        ddsrt_free(block.memory);
        free(expected.data);
        dds_sample_free(sample, type, DDS_FREE_ALL);
    }
}

/* Numbers side by side are one step: what makes a plan worth having. */
static void neighbours_are_one_step(void **state)
{
    (void)state;
    struct wire_plan *plan = wire_plan_create(percuss_v1_Request_desc.m_ops);
    uint32_t longest = 0;
    for (uint32_t i = 0; i < plan->count; i++)
        if (plan->steps[i].kind == WIRE_NUMBERS && plan->steps[i].size == sizeof(double) &&
            plan->steps[i].count > longest)
            longest = plan->steps[i].count;
    /* position, orientation, velocity, angular_velocity */
    assert_int_equal(longest, 3 + 4 + 3 + 3);
    wire_plan_free(plan);
}

static void what_dds_does_not_write_is_refused(void **state)
{
    (void)state;
    percuss_v1_BodyMotion bodies[65] = {{.id = "rod"}};
    percuss_v1_Request request = {.bodies = {._buffer = bodies, ._length = 64, ._maximum = 65}};
    const dds_topic_descriptor_t *type = &percuss_v1_Request_desc;
    struct wire_block block = empty_block(0);
    size_t padding;
    assert_true(writes(type, &request, &block, &padding));
    /* longer than its bound */
    request.bodies._length = 65;
    block.size = 0;
    assert_false(writes(type, &request, &block, &padding));
    /* neither 0 nor 1 */
    request.bodies._length = 0;
    ((uint8_t *)&request)[offsetof(percuss_v1_Request, cancel)] = 2;
    block.size = 0;
    assert_false(writes(type, &request, &block, &padding));
    ddsrt_free(block.memory);
}

static void a_missing_string_is_an_empty_one(void **state)
{
    (void)state;
    char *texts[2] = {NULL, ""};
    percuss_v1_Reply reply = {.warnings = {._buffer = texts, ._length = 2, ._maximum = 2}};
    struct any_bytes expected = any_bytes_of(&reply, percuss_v1_Reply_desc.m_ops, false);
    struct wire_block block = empty_block(0);
    size_t padding;
    assert_true(writes(&percuss_v1_Reply_desc, &reply, &block, &padding));
    assert_memory_equal(block.memory + block.head, expected.data, expected.size);
    ddsrt_free(block.memory);
    free(expected.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bytes_are_those_of_dds),
        cmocka_unit_test(neighbours_are_one_step),
        cmocka_unit_test(what_dds_does_not_write_is_refused),
        cmocka_unit_test(a_missing_string_is_an_empty_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
