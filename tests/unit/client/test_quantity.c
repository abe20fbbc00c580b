/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/quantity.c: numbers with units on the command line. */
#include <string.h>

#include "check.h"
#include "quantity.h"

static struct quantity_fault fault;

static double good(const char *text, enum quantity quantity)
{
    double number = NAN;
    if (!quantity_read(text, strlen(text), quantity, &number, &fault))
        fail_msg("'%s': %s", text, fault.text);
    return number;
}

/* The reason for which it is refused. */
static const char *bad(const char *text, enum quantity quantity)
{
    double number;
    if (quantity_read(text, strlen(text), quantity, &number, &fault))
        fail_msg("'%s' is taken for %g", text, number);
    return fault.text;
}

static void reads_numbers_with_units_and_without(void **state)
{
    (void)state;
    assert_true(good("300mm/s", QUANTITY_SPEED) == 0.3);
    assert_true(good("0.3", QUANTITY_SPEED) == 0.3);
    assert_true(good("-9 us", QUANTITY_TIME) == -9e-6);
    assert_true(good("1e-3", QUANTITY_NUMBER) == 1e-3);
    /* as programs print columns */
    assert_true(good("  0.300 ", QUANTITY_SPEED) == 0.3);
    /* no more than it is given of the text */
    double number;
    assert_true(quantity_read("20 ms:30 ms", 5, QUANTITY_TIME, &number, &fault));
    assert_true(number == 0.02);
    assert_false(quantity_read("  3", 1, QUANTITY_TIME, &number, &fault));
}

static void says_what_is_allowed(void **state)
{
    (void)state;
    assert_string_equal(
        bad("8 kg", QUANTITY_SPEED),
        "a speed is needed, in m/s or with a unit, such as 300 mm/s; kg is no speed");
    assert_string_equal(
        bad("20 msec", QUANTITY_TIME),
        "a time is needed, in s or with a unit, such as 20 ms; msec is no unit that "
        "is known");
    assert_string_equal(bad("soon", QUANTITY_TIME),
                        "a time is needed, in s or with a unit, such as 20 ms");
    assert_string_equal(bad("", QUANTITY_LENGTH),
                        "a length is needed, in m or with a unit, such as 8 mm");
    assert_string_equal(bad("0.5 m", QUANTITY_NUMBER), "a number is needed, without a unit");
    assert_string_equal(bad("inf", QUANTITY_NUMBER), "a number is needed, without a unit");
    /* whatever length it has */
    char text[2000];
    memset(text, 'm', sizeof text - 1);
    text[0] = '1';
    text[sizeof text - 1] = '\0';
    assert_non_null(strstr(bad(text, QUANTITY_LENGTH), "is no unit that is known"));
    memset(text, '1', sizeof text - 1);
    assert_string_equal(bad(text, QUANTITY_LENGTH),
                        "a length is needed, in m or with a unit, such as 8 mm");
}

static void reads_lists(void **state)
{
    (void)state;
    double numbers[3];
    assert_int_equal(quantity_read_list("8 mm", QUANTITY_LENGTH, numbers, 3, &fault), 1);
    assert_int_equal(quantity_read_list("8 mm:0.01:1 cm", QUANTITY_LENGTH, numbers, 3, &fault), 3);
    assert_true(numbers[0] == 0.008 && numbers[1] == 0.01 && numbers[2] == 0.01);
    assert_int_equal(quantity_read_list("1:2:3:4", QUANTITY_LENGTH, numbers, 3, &fault), -1);
    assert_string_equal(fault.text, "up to 3 numbers are allowed");
    assert_int_equal(quantity_read_list("1:2:", QUANTITY_LENGTH, numbers, 3, &fault), -1);
    assert_int_equal(quantity_read_list("1 m:2 s", QUANTITY_LENGTH, numbers, 3, &fault), -1);
    assert_non_null(strstr(fault.text, "s is no length"));
}

static void knows_what_numbers_are_of(void **state)
{
    (void)state;
    assert_int_equal(quantity_of("speed"), QUANTITY_SPEED);
    assert_int_equal(quantity_of("yield"), QUANTITY_STRESS);
    assert_int_equal(quantity_of("radius"), QUANTITY_LENGTH);
    assert_int_equal(quantity_of("density"), QUANTITY_DENSITY);
    assert_int_equal(quantity_of("damping"), QUANTITY_NUMBER);
    assert_int_equal(quantity_of("site"), QUANTITY_NUMBER);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_numbers_with_units_and_without),
        cmocka_unit_test(says_what_is_allowed),
        cmocka_unit_test(reads_lists),
        cmocka_unit_test(knows_what_numbers_are_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
