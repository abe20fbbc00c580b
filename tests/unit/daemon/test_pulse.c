/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/pulse.c: silence grows while a thread works without a sign of life, and only then.
 */
#include <pthread.h>

#include "check.h"
#include "daemon/pulse.h"
#include "exchange/clock.h"

static void rest_is_no_silence(void **state)
{
    (void)state;
    struct pulse pulse = {0};
    assert_true(pulse_silence(&pulse, clock_now() + 100.0) == 0.0);
    /* a thread without a pulse gives no sign */
    pulse_beat();
    assert_true(pulse_silence(&pulse, clock_now() + 100.0) == 0.0);
    pulse_adopt(&pulse);
    double before = clock_now();
    pulse_beat();
    double after = clock_now(), silence = pulse_silence(&pulse, after + 100.0);
    assert_true(silence >= 100.0 && silence <= 100.0 + (after - before));
    /* clocks are read one after the other */
    assert_true(pulse_silence(&pulse, before - 1.0) == 0.0);
    pulse_rest();
    assert_true(pulse_silence(&pulse, clock_now() + 100.0) == 0.0);
    pulse_adopt(NULL);
}

static void *beat_once(void *pulse)
{
    pulse_adopt(pulse);
    pulse_beat();
    return NULL;
}

static void each_thread_has_its_own(void **state)
{
    (void)state;
    struct pulse own = {0}, other = {0};
    pthread_t thread;
    pulse_adopt(&own);
    assert_int_equal(pthread_create(&thread, NULL, beat_once, &other), 0);
    pthread_join(thread, NULL);
    assert_true(pulse_silence(&own, clock_now() + 1.0) == 0.0);
    assert_true(pulse_silence(&other, clock_now() + 1.0) >= 1.0);
    pulse_adopt(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rest_is_no_silence),
        cmocka_unit_test(each_thread_has_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
