/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/measured/column.c. */
#include <string.h>

#include "check.h"
#include "column.h"

static void heading(const char *text, const char *name, const char *unit)
{
    char found_name[HEADING_SIZE], found_unit[UNIT_SIZE];
    column_heading(text, found_name, found_unit);
    assert_string_equal(found_name, name);
    assert_string_equal(found_unit, unit);
}

static void parts_headings(void **state)
{
    (void)state;
    heading("speed", "speed", "");
    heading("speed [mm/s]", "speed", "mm/s");
    heading("Speed (mm/s)", "Speed", "mm/s");
    heading("v / (mm/s)", "v", "mm/s");
    heading("t/ms", "t", "ms");
    heading("v in mm/s", "v", "mm/s");
    heading("v in (mm/s)", "v", "mm/s");
    heading("restitution [-]", "restitution", "");
    heading("impulse [mN\xC2\xB7s]", "impulse", "mN*s");
    heading("impulse [mNs]", "impulse", "mN s");
    heading("time (msec)", "time", "ms");
    /* several headings, by a separator that is not tried */
    heading("speed [m/s];restitution [-]", "speed [m/s];restitution [-]", "");
    heading("", "", "");
    /* longer than any */
    char longest[400];
    memset(longest, '/', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    char name[HEADING_SIZE], unit[UNIT_SIZE];
    column_heading(longest, name, unit);
    assert_int_equal(strlen(unit), UNIT_SIZE - 1);
}

static void reads_numbers_in_units(void **state)
{
    (void)state;
    double value;
    assert_int_equal(column_number(&IMPACT_KINDS[IMPACT_SPEED], "276.4", "mm/s", &value), 0);
    assert_true(value == 0.2764);
    assert_int_equal(column_number(&IMPACT_KINDS[IMPACT_SPEED], "276.4 mm/s", "", &value), 0);
    assert_true(value == 0.2764);
    assert_int_equal(column_number(&IMPACT_KINDS[IMPACT_RESTITUTION], "73.1", "%", &value), 0);
    assert_true(value == 0.731);
    assert_int_not_equal(column_number(&IMPACT_KINDS[IMPACT_SPEED], "276.4 mm/s", "m/s", &value),
                         UNITS_GOOD);
    assert_int_equal(column_accepts(&IMPACT_KINDS[IMPACT_SUB_IMPACTS], "%"), UNITS_UNKNOWN);
    assert_int_equal(column_accepts(&IMPACT_KINDS[IMPACT_HISTORY], "s"), UNITS_OF_ANOTHER);
    assert_int_equal(column_accepts(&IMPACT_KINDS[IMPACT_HISTORY], ""), UNITS_GOOD);
    assert_int_equal(column_accepts(&HISTORY_KINDS[HISTORY_TIME], "m/s"), UNITS_OF_ANOTHER);
    assert_int_equal(column_accepts(&HISTORY_KINDS[HISTORY_TIME], "fortnight"), UNITS_UNKNOWN);
}

static void choice(const char *text, const char *heading, const char *unit)
{
    struct column_map map = {0};
    struct measured_fault fault;
    if (!column_map_add(&map, text, &fault))
        fail_msg("%s", fault.text);
    assert_ptr_equal(map.choices[0].kind, &IMPACT_KINDS[IMPACT_SPEED]);
    assert_ptr_equal(column_map_find(&map, &IMPACT_KINDS[IMPACT_SPEED]), &map.choices[0]);
    assert_null(column_map_find(&map, &IMPACT_KINDS[IMPACT_AT]));
    assert_string_equal(map.choices[0].heading, heading);
    assert_string_equal(map.choices[0].unit, unit);
}

static void refuse(struct column_map *map, const char *text, const char *words)
{
    struct measured_fault fault = {""};
    if (column_map_add(map, text, &fault))
        fail_msg("accepted: %s", text);
    if (!strstr(fault.text, words))
        fail_msg("'%s' does not say '%s'", fault.text, words);
}

static void takes_choices(void **state)
{
    (void)state;
    choice("speed=v", "v", "");
    choice("speed=v:mm/s", "v", "mm/s");
    choice("speed=Plot 0:A:mm/s", "Plot 0:A", "mm/s");
    choice("speed=Plot 0:A:", "Plot 0:A", "");
    choice("speed=a=b", "a=b", "");
    choice("speed=3:mm/s", "3", "mm/s");
    struct column_map map = {0};
    struct measured_fault fault;
    refuse(&map, "speed", "'speed': NAME=HEADING[:UNIT] is needed");
    refuse(&map, "speed=", "NAME=HEADING[:UNIT] is needed");
    refuse(&map, "speed=:mm", "a heading of 1 to 127 bytes is needed");
    refuse(&map, "=v", "'' is none of speed, restitution");
    refuse(&map, "sped=v", "'sped' is none of speed, restitution");
    refuse(&map, "speed=v:mm", "'mm': must be a unit of speed, as in 300 mm/s");
    refuse(&map, "restitution=e:m", "'m': must be nothing or %");
    refuse(
        &map, "restitution=v_out",
        "'restitution=v_out': v_out is in m/s, restitution has no unit: v_out is a column of its "
        "own");
    refuse(&map, "first_impulse=Speed", "speed is in m/s, first_impulse in N s");
    refuse(&map, "sub_impacts=n:%", "'%': must be nothing: sub_impacts has no unit");
    assert_true(column_map_add(&map, "speed=v", &fault));
    refuse(&map, "speed=w", "speed is given twice");
    assert_int_equal(map.count, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_headings),
        cmocka_unit_test(reads_numbers_in_units),
        cmocka_unit_test(takes_choices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
