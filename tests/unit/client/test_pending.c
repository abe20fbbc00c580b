/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/lib/pending.c: finding by sequence, order of arrival, the window. */
#include "check.h"
#include "pending.h"

static struct pending *add(struct pending_table *table, uint64_t sequence)
{
    struct pending *pending;
    assert_int_equal(pending_add(table, sequence, &pending), PERCUSS_RESULT_OK);
    return pending;
}

static void finds_by_sequence(void **state)
{
    (void)state;
    struct pending_table table = {.window = 1024};
    /* several share a bucket */
    for (uint64_t i = 1; i <= 4 * PENDING_BUCKETS; i++)
        add(&table, i);
    for (uint64_t i = 1; i <= 4 * PENDING_BUCKETS; i += 2)
        pending_remove(&table, pending_find(&table, i));
    for (uint64_t i = 1; i <= 4 * PENDING_BUCKETS; i++) {
        struct pending *pending = pending_find(&table, i);
        assert_int_equal(pending != NULL, i % 2 == 0);
        assert_true(!pending || pending->sequence == i);
    }
    assert_int_equal(table.count, 2 * PENDING_BUCKETS);
    pending_clear(&table);
    assert_int_equal(table.count, 0);
}

static void hands_out_in_order_of_arrival(void **state)
{
    (void)state;
    struct pending_table table = {.window = 8};
    for (uint64_t i = 1; i <= 5; i++)
        add(&table, i);
    pending_find(&table, 4)->waited = true;
    const uint64_t arrivals[] = {3, 4, 1, 5, 2};
    for (int i = 0; i < 5; i++)
        pending_set_ready(&table, pending_find(&table, arrivals[i]), PERCUSS_RESULT_OK);
    /* 4 belongs to a thread that waits for it; 1 is taken by its sequence */
    pending_remove(&table, pending_find(&table, 1));
    const uint64_t expected[] = {3, 5, 2};
    for (int i = 0; i < 3; i++) {
        struct pending *first = pending_first_ready(&table);
        assert_int_equal(first->sequence, expected[i]);
        pending_remove(&table, first);
    }
    assert_null(pending_first_ready(&table));
    assert_false(pending_has_unwaited(&table));
    assert_int_equal(table.count, 1);
    pending_clear(&table);
    assert_null(table.first_ready);
    assert_null(table.last_ready);
}

static void tells_whose_server_has_gone(void **state)
{
    (void)state;
    struct pending_table table = {.window = 8};
    for (uint64_t i = 1; i <= 3; i++)
        add(&table, i);
    assert_null(pending_first_orphan(&table));
    /* an answer stays one; 2 belongs to a thread that waits for it */
    pending_set_ready(&table, pending_find(&table, 1), PERCUSS_RESULT_OK);
    pending_find(&table, 2)->waited = true;
    pending_orphan(&table);
    assert_false(pending_find(&table, 1)->orphaned);
    assert_true(pending_find(&table, 2)->orphaned);
    assert_int_equal(pending_first_orphan(&table)->sequence, 3);
    /* what is asked later is asked of the successor */
    pending_remove(&table, pending_find(&table, 3));
    add(&table, 4);
    assert_null(pending_first_orphan(&table));
    pending_clear(&table);
}

static void keeps_the_window(void **state)
{
    (void)state;
    struct pending_table table = {.window = 2};
    struct pending *pending;
    add(&table, 1);
    add(&table, 2);
    assert_int_equal(pending_add(&table, 3, &pending), PERCUSS_RESULT_WINDOW_FULL);
    pending_remove(&table, pending_find(&table, 1));
    add(&table, 3);
    pending_clear(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_by_sequence),
        cmocka_unit_test(hands_out_in_order_of_arrival),
        cmocka_unit_test(tells_whose_server_has_gone),
        cmocka_unit_test(keeps_the_window),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
