/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/inbox.c: writers take turns, each in his order, and lose the oldest of too many.
 */
#include "check.h"
#include "endpoint/inbox.h"

static int released;

static void note_released(void *sample)
{
    released += *(int *)sample;
}

static void writers_take_turns(void **state)
{
    (void)state;
    int samples[] = {1, 2, 3, 4, 5};
    static const uint64_t writers[] = {7, 7, 7, 8, 9};
    static const int order[] = {1, 4, 5, 2, 3};
    struct inbox *inbox = inbox_create(10, note_released);
    assert_true(inbox_is_empty(inbox));
    uint64_t writer;
    assert_null(inbox_take(inbox, &writer));
    for (int i = 0; i < 5; i++)
        inbox_put(inbox, writers[i], &samples[i]);
    for (int i = 0; i < 5; i++) {
        assert_false(inbox_is_empty(inbox));
        assert_int_equal(*(int *)inbox_take(inbox, &writer), order[i]);
        assert_int_equal(writer, writers[order[i] - 1]);
    }
    assert_true(inbox_is_empty(inbox));
    inbox_free(inbox);
}

static void too_many_push_out_the_oldest(void **state)
{
    (void)state;
    int samples[] = {1, 10, 100, 1000};
    struct inbox *inbox = inbox_create(2, note_released);
    released = 0;
    for (int i = 0; i < 3; i++)
        inbox_put(inbox, 7, &samples[i]);
    inbox_put(inbox, 8, &samples[3]);
    assert_int_equal(released, 1);
    uint64_t writer;
    assert_int_equal(*(int *)inbox_take(inbox, &writer), 10);
    assert_int_equal(writer, 7);
    /* what is left goes with it */
    inbox_free(inbox);
    assert_int_equal(released, 1101);
    inbox_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(writers_take_turns),
        cmocka_unit_test(too_many_push_out_the_oldest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
