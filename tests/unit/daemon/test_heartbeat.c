/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/pool.c: a heartbeat's silence grows while a thread works without a sign of life, and
 * only then. */
#include <pthread.h>

#include "check.h"
#include "daemon/pool.h"
#include "exchange/clock.h"

static void rest_is_no_silence(void **state)
{
    (void)state;
    struct heartbeat heartbeat = {0};
    assert_true(heartbeat_silence(&heartbeat, clock_now() + 100.0) == 0.0);
    /* a thread without a heartbeat gives no sign */
    heartbeat_beat();
    assert_true(heartbeat_silence(&heartbeat, clock_now() + 100.0) == 0.0);
    heartbeat_adopt(&heartbeat);
    double before = clock_now();
    heartbeat_beat();
    double after = clock_now(), silence = heartbeat_silence(&heartbeat, after + 100.0);
    assert_true(silence >= 100.0 && silence <= 100.0 + (after - before));
    /* clocks are read one after the other */
    assert_true(heartbeat_silence(&heartbeat, before - 1.0) == 0.0);
    heartbeat_rest();
    assert_true(heartbeat_silence(&heartbeat, clock_now() + 100.0) == 0.0);
    heartbeat_adopt(NULL);
}

static void *beat_once(void *heartbeat)
{
    heartbeat_adopt(heartbeat);
    heartbeat_beat();
    return NULL;
}

static void each_thread_has_its_own(void **state)
{
    (void)state;
    struct heartbeat own = {0}, other = {0};
    pthread_t thread;
    heartbeat_adopt(&own);
    assert_int_equal(pthread_create(&thread, NULL, beat_once, &other), 0);
    pthread_join(thread, NULL);
    assert_true(heartbeat_silence(&own, clock_now() + 1.0) == 0.0);
    assert_true(heartbeat_silence(&other, clock_now() + 1.0) >= 1.0);
    heartbeat_adopt(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rest_is_no_silence),
        cmocka_unit_test(each_thread_has_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
