/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api/quantity.c: numbers with units for programs. */
#include <percuss/quantity.h>

#include "check.h"

static double good(const char *text, const char *quantity)
{
    double value = NAN;
    if (percuss_quantity_parse(text, quantity, &value) != PERCUSS_RESULT_OK)
        fail_msg("'%s': %s", text, percuss_error_text());
    return value;
}

/* The reason for which it is refused. */
static const char *bad(const char *text, const char *quantity)
{
    double value = 7.0;
    assert_int_equal(percuss_quantity_parse(text, quantity, &value),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_true(value == 7.0);
    return percuss_error_text();
}

static void reads_numbers_of_every_quantity(void **state)
{
    (void)state;
    assert_true(good("300mm/s", "speed") == 0.3);
    assert_true(good("0.3", "speed") == 0.3);
    assert_true(good("  9 mm", "length") == 9e-3);
    assert_true(good("70 GPa", "stress") == 70e9);
    assert_true(good("2.7 g/cm^3", "density") == 2700.0);
    assert_true(good("20 kHz", "frequency") == 20e3);
    assert_true(good("20ms", "time") == 0.02);
    assert_true(good("30 mN s", "impulse") == 0.03);
    assert_true(good("5 1/m", "curvature") == 5.0);
    assert_true(good("-0.5", "number") == -0.5);
}

static void says_what_is_allowed(void **state)
{
    (void)state;
    assert_string_equal(
        bad("8 kg", "speed"),
        "'8 kg': a speed is needed, in m/s or with a unit, such as 300 mm/s; kg is no speed");
    assert_string_equal(bad("soon", "time"),
                        "'soon': a time is needed, in s or with a unit, such as 20 ms");
    assert_string_equal(bad("0.5 m", "number"), "'0.5 m': a number is needed, without a unit");
    bad("nan", "number");
    bad("1e999", "length");
    bad("", "length");
    assert_string_equal(bad("3", "velocity"),
                        "quantity: 'velocity': one of number, length, stress, density, curvature, "
                        "frequency, speed, time, impulse, acceleration is allowed");
}

static void names_what_is_missing(void **state)
{
    (void)state;
    assert_string_equal(bad(NULL, "speed"), "text: NULL: a pointer is needed");
    assert_string_equal(bad("3", NULL), "quantity: NULL: a pointer is needed");
    assert_int_equal(percuss_quantity_parse("3", "speed", NULL), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_string_equal(percuss_error_text(), "value: NULL: a pointer is needed");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_numbers_of_every_quantity),
        cmocka_unit_test(says_what_is_allowed),
        cmocka_unit_test(names_what_is_missing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
