/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/writer_queues.c: writers take turns, each in its order, and lose the oldest
 * sample of too many. */
#include "check.h"
#include "endpoint/writer_queues.h"

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
    struct writer_queues *queues = writer_queues_create(10, note_released);
    assert_true(writer_queues_is_empty(queues));
    uint64_t writer;
    assert_null(writer_queues_take(queues, &writer));
    for (int i = 0; i < 5; i++)
        writer_queues_put(queues, writers[i], &samples[i]);
    for (int i = 0; i < 5; i++) {
        assert_false(writer_queues_is_empty(queues));
        assert_int_equal(*(int *)writer_queues_take(queues, &writer), order[i]);
        assert_int_equal(writer, writers[order[i] - 1]);
    }
    assert_true(writer_queues_is_empty(queues));
    writer_queues_free(queues);
}

static void too_many_push_out_the_oldest(void **state)
{
    (void)state;
    int samples[] = {1, 10, 100, 1000};
    struct writer_queues *queues = writer_queues_create(2, note_released);
    released = 0;
    for (int i = 0; i < 3; i++)
        writer_queues_put(queues, 7, &samples[i]);
    writer_queues_put(queues, 8, &samples[3]);
    assert_int_equal(released, 1);
    uint64_t writer;
    assert_int_equal(*(int *)writer_queues_take(queues, &writer), 10);
    assert_int_equal(writer, 7);
    /* what is left goes with it */
    writer_queues_free(queues);
    assert_int_equal(released, 1101);
    writer_queues_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(writers_take_turns),
        cmocka_unit_test(too_many_push_out_the_oldest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
