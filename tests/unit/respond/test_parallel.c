/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests respond/parallel.c: every item once, and how far all are done when it is stopped. */
#include <stdatomic.h>
#include <time.h>

#include "check.h"
#include "respond/parallel.h"

enum { ITEMS = 1000, FIRST = 7 };

struct count {
    atomic_int worked[ITEMS];
    int watched;
    uint64_t refused; /* the item that is given up */
    bool slow, stops;
};

static bool work(void *context, unsigned thread, uint64_t item)
{
    struct count *count = context;
    (void)thread;
    if (count->slow)
        nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
    atomic_fetch_add(&count->worked[item], 1);
    return item != count->refused;
}

static bool watch(void *context, uint64_t done)
{
    struct count *count = context;
    count->watched++;
    for (uint64_t i = FIRST; i < done; i++)
        assert_int_equal(atomic_load(&count->worked[i]), 1);
    return !count->stops;
}

static uint64_t run(struct count *count, unsigned threads)
{
    const struct parallel_loop loop = {threads, FIRST, ITEMS, work, watch, count, 0};
    return parallel_run(&loop);
}

static void every_item_is_worked_on_once(void **state)
{
    (void)state;
    for (unsigned threads = 1; threads <= 5; threads += 2) {
        struct count count = {.refused = ITEMS};
        assert_int_equal(run(&count, threads), ITEMS);
        for (int i = 0; i < ITEMS; i++)
            assert_int_equal(atomic_load(&count.worked[i]), i >= FIRST);
    }
}

static void what_is_done_has_no_gaps(void **state)
{
    (void)state;
    /* stopped by the watch, after about 0.1 s of the 0.5 s that four threads would need */
    struct count stopped = {.refused = ITEMS, .slow = true, .stops = true};
    uint64_t done = run(&stopped, 4);
    assert_int_equal(stopped.watched > 0, true);
    assert_in_range(done, FIRST + 1, ITEMS - 1);
    for (uint64_t i = FIRST; i < done; i++)
        assert_int_equal(atomic_load(&stopped.worked[i]), 1);
    /* and where one item is given up */
    struct count refusing = {.refused = 500};
    assert_int_equal(run(&refusing, 1), 500);
}

static void without_threads_nothing_is_done(void **state)
{
    (void)state;
    struct count count = {.refused = ITEMS};
    assert_int_equal(run(&count, 0), FIRST);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_item_is_worked_on_once),
        cmocka_unit_test(what_is_done_has_no_gaps),
        cmocka_unit_test(without_threads_nothing_is_done),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
