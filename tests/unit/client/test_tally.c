/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/twins/tally.c: the warnings of many replies, each kind once. */
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "tally_output.h"

static void take(struct tally *tally, const char *place, char *first, char *second)
{
    char *warnings[2] = {first, second};
    struct percuss_reply reply = {.warnings = warnings};
    reply.warning_count = (first != NULL) + (second != NULL);
    assert_true(tally_take(tally, &reply, place));
}

/* Line `i` of the JSON is `expected`. */
static void line_is(const struct tally *tally, size_t i, const char *expected)
{
    json_t *array = tally_to_json(tally);
    assert_string_equal(json_string_value(json_array_get(array, i)), expected);
    json_decref(array);
}

static void counts_each_kind_once(void **state)
{
    (void)state;
    struct tally tally = {.unit = "points"};
    take(&tally, "at 1 m/s", NULL, NULL);
    take(&tally, "at 60 m/s", "contacts[0]: 60 m/s is more than 1 % of al-rod-1 (5092 m/s): ends",
         NULL);
    take(&tally, "at 70 m/s",
         "contacts[0]: 7e+01 m/s is more than 1 % of al-rod-1 (5092 m/s): ends",
         "contacts[0]: edge");
    assert_int_equal(tally.count, 2);
    line_is(&tally, 0,
            "points: 2 of 3, first at 60 m/s: contacts[0]: 60 m/s is more than 1 % of al-rod-1 "
            "(5092 m/s): ends");
    line_is(&tally, 1, "points: 1 of 3, first at 70 m/s: contacts[0]: edge");
    tally_clear(&tally);
    assert_int_equal(tally.asked + tally.count, 0);
    assert_string_equal(tally.unit, "points");
    tally_clear(&tally);
}

/* Digits in names and indices are no numbers. */
static void names_tell_kinds_apart(void **state)
{
    (void)state;
    struct tally tally = {.unit = "points"};
    take(&tally, "a", "edge of al-rod-1", "edge of al-rod-2");
    take(&tally, "b", "contacts[0]: edge", "contacts[1]: edge");
    take(&tally, "c", "edge of 9mm-ball", "edge of 8mm-ball");
    assert_int_equal(tally.count, 6);
    take(&tally, "d", "speed -3.5e-4, and (1e5 Pa)", "speed 12, and (0.5 Pa)");
    assert_int_equal(tally.count, 7);
    /* one reply, counted once */
    line_is(&tally, 6, "points: 1 of 4, first d: speed -3.5e-4, and (1e5 Pa)");
    tally_clear(&tally);
}

static void a_warning_status_counts_too(void **state)
{
    (void)state;
    struct tally tally = {.unit = "twins"};
    struct percuss_reply reply = {.status = PERCUSS_TRUNCATED};
    strcpy(reply.message, "the horizon was reached");
    assert_true(tally_take(&tally, &reply, "impact 1"));
    take(&tally, "impact 2", NULL, NULL);
    line_is(&tally, 0, "twins: 1 of 2, first impact 1: TRUNCATED: the horizon was reached");
    tally_clear(&tally);
}

static void many_kinds(void **state)
{
    (void)state;
    struct tally tally = {.unit = "points"};
    char text[600];
    for (int i = 0; i < 100; i++) {
        snprintf(text, sizeof text, "body-%d", i);
        take(&tally, "p", text, NULL);
    }
    assert_int_equal(tally.count, 100);
    /* longer than any text that is kept */
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    take(&tally, text, text, text);
    assert_int_equal(tally.count, 101);
    tally_clear(&tally);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_each_kind_once),
        cmocka_unit_test(names_tell_kinds_apart),
        cmocka_unit_test(a_warning_status_counts_too),
        cmocka_unit_test(many_kinds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
