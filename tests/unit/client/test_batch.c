/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/lib/batch.c: parts in any order, twice, of two servers, missing, impossible. */
#include <string.h>

#include "batch.h"
#include "check.h"

/* Part number `part` of 3 with two replies, of sequences 10 part and 10 part + 1. */
static percuss_v1_BatchReply part_of_three(uint32_t part, uint8_t server)
{
    static percuss_v1_Reply replies[2];
    replies[0] = (percuss_v1_Reply){.sequence = 10 * part};
    replies[1] = (percuss_v1_Reply){.sequence = 10 * part + 1};
    percuss_v1_BatchReply wire = {.part = part, .parts = 3, .server = {server}};
    wire.replies._buffer = replies;
    wire.replies._length = 2;
    return wire;
}

static enum percuss_result add(struct batch *batch, uint32_t part, uint8_t server)
{
    percuss_v1_BatchReply wire = part_of_three(part, server);
    return batch_add_part(batch, &wire);
}

static void puts_parts_in_order(void **state)
{
    (void)state;
    struct batch batch = {0};
    struct percuss_reply replies[6];
    assert_int_equal(add(&batch, 2, 7), PERCUSS_RESULT_PENDING);
    assert_int_equal(add(&batch, 2, 7), PERCUSS_RESULT_PENDING); /* again */
    assert_int_equal(add(&batch, 0, 8), PERCUSS_RESULT_PENDING); /* of another server */
    assert_int_equal(add(&batch, 0, 7), PERCUSS_RESULT_PENDING);
    assert_int_equal(add(&batch, 1, 7), PERCUSS_RESULT_OK);
    batch_collect(&batch, replies, 6);
    for (uint64_t i = 0; i < 6; i++) {
        assert_int_equal(replies[i].sequence, 10 * (i / 2) + i % 2);
        assert_int_equal(replies[i].status, PERCUSS_OK);
        percuss_reply_free(&replies[i]);
    }
    batch_clear(&batch);
}

static void fills_in_for_missing_answers(void **state)
{
    (void)state;
    struct batch batch = {0};
    struct percuss_reply replies[7];
    for (uint32_t part = 0; part < 3; part++)
        add(&batch, part, 7);
    batch_collect(&batch, replies, 7);
    assert_int_equal(replies[6].status, PERCUSS_INTERNAL);
    assert_non_null(strstr(replies[6].message, "no answer"));
    for (int i = 0; i < 7; i++)
        percuss_reply_free(&replies[i]);
    batch_clear(&batch);
}

static void a_refused_batch_refuses_every_question(void **state)
{
    (void)state;
    struct batch batch = {0};
    struct percuss_reply replies[2];
    percuss_v1_BatchReply wire = {
        .parts = 1, .status = percuss_v1_STATUS_BUSY, .message = "queue full"};
    assert_int_equal(batch_add_part(&batch, &wire), PERCUSS_RESULT_OK);
    batch_collect(&batch, replies, 2);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(replies[i].status, PERCUSS_BUSY);
        assert_string_equal(replies[i].message, "queue full");
    }
    batch_clear(&batch);
}

static void drops_impossible_parts(void **state)
{
    (void)state;
    struct batch batch = {0};
    percuss_v1_BatchReply none = {.part = 0, .parts = 0};
    percuss_v1_BatchReply beyond = {.part = 3, .parts = 3};
    percuss_v1_BatchReply many = {.part = 0, .parts = UINT32_MAX};
    percuss_v1_BatchReply other = {.part = 0, .parts = 2, .server = {7}};
    assert_int_equal(batch_add_part(&batch, &none), PERCUSS_RESULT_PENDING);
    assert_int_equal(batch_add_part(&batch, &beyond), PERCUSS_RESULT_PENDING);
    assert_int_equal(batch_add_part(&batch, &many), PERCUSS_RESULT_PENDING);
    assert_int_equal(batch.parts, 0);
    add(&batch, 1, 7);
    assert_int_equal(batch_add_part(&batch, &other), PERCUSS_RESULT_PENDING);
    assert_int_equal(batch.missing, 2);
    batch_clear(&batch); /* with replies that were not collected */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(puts_parts_in_order),
        cmocka_unit_test(fills_in_for_missing_answers),
        cmocka_unit_test(a_refused_batch_refuses_every_question),
        cmocka_unit_test(drops_impossible_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
