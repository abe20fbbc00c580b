/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests the limit of daemon/log.c by a clock of its own: how many lines of a kind pass, and how the
 * others are summed up. */
#include "daemon/log.h"

#include <stdio.h>
#include <string.h>

#include "check.h"

static struct log_rate rate;
static double now;

static int clear(void **state)
{
    (void)state;
    memset(&rate, 0, sizeof rate);
    now = 1000.0;
    return 0;
}

/* How many of so many lines pass, `step` seconds apart. */
static unsigned passed(const char *format, const char *message, unsigned count, double step)
{
    unsigned written = 0;
    for (unsigned i = 0; i < count; i++, now += step)
        written +=
            log_rate_admits(&rate, log_rate_kind(format, message), LEVEL_ERROR, message, now);
    return written;
}

static void says(bool all, const char *expected)
{
    char text[300];
    enum log_level level = LEVEL_DEBUG;
    if (!log_rate_sum(&rate, now, all, &level, text, sizeof text))
        fail_msg("no sum");
    assert_string_equal(text, expected);
    assert_int_equal(level, LEVEL_ERROR);
}

static void says_nothing(bool all)
{
    char text[300];
    enum log_level level;
    assert_false(log_rate_sum(&rate, now, all, &level, text, sizeof text));
}

static void a_flood_is_summed_up(void **state)
{
    (void)state;
    assert_int_equal(passed("store: %s", "store: full", 20 + 8123, 0.001), 20);
    says_nothing(false);
    now = 1060.0;
    says(false, "and 8,123 more in 60 s: store: full");
    says_nothing(true);
    /* the next period, which the end of the process cuts short */
    assert_int_equal(passed("store: %s", "store: full", 21, 0.1), 20);
    says(true, "and 1 more in 2 s: store: full");
    says_nothing(true);
    assert_int_equal(passed("store: %s", "store: full", 1234567 + 20, 1e-6), 20);
    now += 100.0;
    says(false, "and 1,234,567 more in 101 s: store: full");
}

/* Four minutes of 186 refused impacts a second. */
static void four_minutes(void **state)
{
    (void)state;
    unsigned written = 0, sums = 0;
    char text[300];
    enum log_level level;
    for (int second = 0; second < 240; second++, now = 1000.0 + second) {
        written += passed("%s", "specimens.db: the impact is not stored: database or disk is full",
                          186, 0.0);
        while (log_rate_sum(&rate, now, false, &level, text, sizeof text))
            sums++;
    }
    assert_int_equal(written, 80);
    assert_int_equal(sums, 3);
}

static void what_is_rare_passes(void **state)
{
    (void)state;
    /* one in four seconds is 15 a minute */
    assert_int_equal(passed("%s", "the time went back", 1000, 4.0), 1000);
    says_nothing(true);
}

static void kinds_do_not_hide_each_other(void **state)
{
    (void)state;
    /* a format is a kind, whatever is in its place */
    assert_true(log_rate_kind("client %s", "client a") == log_rate_kind("client %s", "client b"));
    assert_false(log_rate_kind("client %s", "client a") == log_rate_kind("server %s", "server a"));
    /* without one the message is, but for its numbers */
    assert_true(log_rate_kind("%s", "reply 9 of 12") == log_rate_kind("%s", "reply 10 of 3"));
    assert_false(log_rate_kind("%s", "reply 9 of 12") == log_rate_kind("%s", "reply 9"));
    assert_int_equal(passed("a", "a", 1000, 0.0), 20);
    assert_int_equal(passed("b", "b", 10, 0.0), 10);
    now += 60.0;
    says(false, "and 980 more in 60 s: a");
    says_nothing(true);
}

/* More kinds than places: the log stays bounded, and a place is free again after its period. */
static void any_number_of_kinds_is_bounded(void **state)
{
    (void)state;
    unsigned written = 0;
    char text[300], format[32];
    enum log_level level;
    for (int i = 0; i < 100000; i++) {
        snprintf(format, sizeof format, "%c%c%c%c", 'a' + i % 26, 'a' + i / 26 % 26,
                 'a' + i / 676 % 26, 'a' + i / 17576 % 26);
        written += passed(format, format, 1, 0.0);
    }
    assert_int_equal(written, LOG_RATE_KINDS + LOG_RATE_LINES);
    now += 60.0;
    assert_true(log_rate_sum(&rate, now, false, &level, text, sizeof text));
    assert_non_null(strstr(text, "and 99,916 more in 60 s of several kinds: "));
    says_nothing(true);
    assert_int_equal(passed("new", "new", 1000, 0.0), 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_flood_is_summed_up, clear),
        cmocka_unit_test_setup(four_minutes, clear),
        cmocka_unit_test_setup(what_is_rare_passes, clear),
        cmocka_unit_test_setup(kinds_do_not_hide_each_other, clear),
        cmocka_unit_test_setup(any_number_of_kinds_is_bounded, clear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
