/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/base/text.c. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "check.h"

static void check_number(double value, int digits)
{
    char mine[64], theirs[64];
    struct text text = text_begin(mine, sizeof mine);
    text_add_number(&text, value, digits);
    snprintf(theirs, sizeof theirs, "%.*g", digits, value);
    assert_string_equal(mine, theirs);
    assert_ptr_equal(text.at, mine + strlen(mine));
}

/* printf is the second way: what is exactly between two decimals, what rounds to one digit more,
 * the ends of the plain notation, and what is no ordinary number. */
static void test_numbers_are_printf_s(void **state)
{
    (void)state;
    static const double values[] = {0.0,
                                    -0.0,
                                    1.0,
                                    10.0,
                                    100.0,
                                    1000.0,
                                    1e4,
                                    123456.0,
                                    0.5,
                                    2.5,
                                    0.125,
                                    0.0625,
                                    1.005,
                                    999.5,
                                    999.4999,
                                    99.95,
                                    9.995,
                                    0.9995,
                                    9.9995,
                                    99999.5,
                                    0.00009995,
                                    1e-4,
                                    9.999e-5,
                                    1.2345e-4,
                                    1e-5,
                                    1e22,
                                    1e23,
                                    1.5e300,
                                    5e-324,
                                    2.2e-308,
                                    1e-22,
                                    7.0,
                                    -3.25,
                                    1234.5,
                                    12345.0,
                                    3.14159,
                                    INFINITY,
                                    -INFINITY,
                                    999999.5,
                                    1e9,
                                    123456789.5,
                                    1e15,
                                    4503599627370497.5};
    for (size_t i = 0; i < COUNT(values); i++)
        for (int digits = 1; digits <= 12; digits++)
            check_number(values[i], digits);
    check_number(nan(""), 3);
}

/* Of any size that a double has, and with few digits, so that many lie between two decimals. */
static void test_random_numbers(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < 200000; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        double mantissa = (double)(seed >> 40) / 16777216.0 + 0.5;
        int exponent = (int)(seed >> 8 & 127) - 64;
        check_number(ldexp(mantissa, exponent), 1 + i % 9);
        check_number((double)(seed >> 44) / 1000.0, 1 + i % 9);
    }
}

/* Pieces one after the other, and an end however small the buffer is. */
static void test_texts_end(void **state)
{
    (void)state;
    char buffer[32];
    struct text text = text_begin(buffer, sizeof buffer);
    assert_string_equal(buffer, "");
    text_add(&text, "of ");
    text_add_count(&text, 0);
    text_format(&text, " to %d: ", 7);
    text_add_count(&text, 1234567890);
    assert_string_equal(buffer, "of 0 to 7: 1234567890");
    for (size_t size = 1; size < 12; size++) {
        memset(buffer, 'x', sizeof buffer);
        text = text_begin(buffer, size);
        text_add_count(&text, 1234);
        text_add_number(&text, 0.25, 3);
        text_format(&text, "%s", "more");
        text_add(&text, "last");
        assert_memory_equal(buffer, "12340.25more", size - 1);
        assert_int_equal(buffer[size - 1], '\0');
        assert_int_equal(buffer[size], 'x');
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_are_printf_s),
        cmocka_unit_test(test_random_numbers),
        cmocka_unit_test(test_texts_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
