/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests idl/wire_clock.c by a time of day that is set here. That threads of DDS are woken is shown
 * in tests/service/faults/clock_steps.sh. */
#include "wire_clock.h"

#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "check.h"

static time_t set_by;       /* s */
static unsigned interrupts; /* readings of the time of day that come late */

/* In place of the C library's. */
int clock_gettime(clockid_t clock, struct timespec *now)
{
    static const struct timespec pause = {.tv_nsec = 60000000};
    const bool is_late = clock == CLOCK_REALTIME && interrupts > 0;
    if (is_late)
        interrupts--;
    if (is_late)
        nanosleep(&pause, NULL);
    int result = (int)syscall(SYS_clock_gettime, clock, now);
    if (clock == CLOCK_REALTIME)
        now->tv_sec += set_by;
    return result;
}

static void test_steps_are_told_once(void **state)
{
    (void)state;
    struct wire_clock clock = wire_clock_start();
    set_by = -180000;
    double step = wire_clock_step(&clock);
    /* both looks may have been interrupted, by less than what counts as a step */
    near(step, -180000.0, 0.02);
    assert_true(wire_clock_is_back(step));
    assert_false(wire_clock_is_back(wire_clock_step(&clock)));
    set_by = 3600;
    step = wire_clock_step(&clock);
    near(step, 183600.0, 0.02);
    assert_false(wire_clock_is_back(step));
}

/* A look that is interrupted between one clock and the other sees them 60 ms apart. */
static void test_interruptions_are_no_steps(void **state)
{
    (void)state;
    interrupts = 2;
    struct wire_clock clock = wire_clock_start();
    assert_int_equal(interrupts, 0);
    assert_false(wire_clock_is_back(wire_clock_step(&clock)));
    interrupts = 3;
    assert_false(wire_clock_is_back(wire_clock_step(&clock)));
    assert_false(wire_clock_is_back(wire_clock_step(&clock)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_steps_are_told_once),
        cmocka_unit_test(test_interruptions_are_no_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
