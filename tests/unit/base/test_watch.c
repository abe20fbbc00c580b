/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/base/watch.c: who waits is asked once in so much work, and never again after no.
 */
#include "base/watch.h"
#include "check.h"

struct waiting {
    int asked, patience;
    double done;
};

static bool proceed(void *context, double done)
{
    struct waiting *waiting = context;
    waiting->done = done;
    return ++waiting->asked <= waiting->patience;
}

static void asks_once_in_so_much_work(void **state)
{
    (void)state;
    struct waiting waiting = {.patience = 1000};
    struct watch watch = {proceed, &waiting};
    struct pace pace = {.watch = &watch};
    for (int i = 0; i < 1000; i++)
        assert_true(pace_keeps(&pace, 0.01 * PACE_WORK * 1.0001));
    assert_int_equal(waiting.asked, 10);
    assert_true(pace_keeps(&pace, 100.0 * PACE_WORK));
    assert_int_equal(waiting.asked, 11);
    assert_true(pace_ask(&pace, 0.5));
    assert_int_equal(waiting.asked, 12);
    assert_true(waiting.done == 0.5);
    assert_int_equal(pace_status(&pace), PERCUSS_OK);
}

static void no_is_no(void **state)
{
    (void)state;
    struct waiting waiting = {.patience = 2};
    struct watch watch = {proceed, &waiting};
    struct pace pace = {.watch = &watch};
    assert_true(pace_ask(&pace, 0.0));
    assert_true(pace_keeps(&pace, PACE_WORK));
    assert_false(pace_keeps(&pace, PACE_WORK));
    assert_int_equal(pace_status(&pace), PERCUSS_TIMEOUT);
    /* at once from now on, and nobody is bothered */
    assert_false(pace_keeps(&pace, 0.0));
    assert_false(pace_ask(&pace, 1.0));
    assert_int_equal(waiting.asked, 3);
}

static void nobody_objects(void **state)
{
    (void)state;
    struct watch nobody = {NULL, NULL};
    struct pace pace = {.watch = &nobody}, alone = {.watch = NULL};
    assert_true(pace_keeps(&pace, 10.0 * PACE_WORK) && pace_keeps(&alone, 10.0 * PACE_WORK));
    assert_true(pace_keeps(NULL, 10.0 * PACE_WORK) && pace_ask(NULL, 0.0));
    assert_int_equal(pace_status(NULL), PERCUSS_OK);
}

static void failures_say_what_they_are(void **state)
{
    (void)state;
    struct fault fault = {"untouched"};
    assert_int_equal(pace_fault(&fault, PERCUSS_OK), PERCUSS_OK);
    assert_string_equal(fault.text, "untouched");
    assert_int_equal(pace_fault(&fault, PERCUSS_TIMEOUT), PERCUSS_TIMEOUT);
    assert_string_equal(fault.text, "stopped before the end");
    assert_int_equal(pace_fault(&fault, PERCUSS_INTERNAL), PERCUSS_INTERNAL);
    assert_string_equal(fault.text, "out of memory");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(asks_once_in_so_much_work),
        cmocka_unit_test(no_is_no),
        cmocka_unit_test(nobody_objects),
        cmocka_unit_test(failures_say_what_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
