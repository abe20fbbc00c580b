/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/measured/divide.c. */
#include <string.h>

#include "check.h"
#include "divide.h"

/* The cells, each behind a bar. */
static void divides(const char *text, char separator, const char *expected, size_t filled)
{
    char line[200], joined[200] = "", *cells[20];
    size_t all;
    strcpy(line, text);
    assert_int_equal(divide_line(line, separator, cells, COUNT(cells), &all), filled);
    for (size_t i = 0; i < all; i++) {
        strcat(joined, "|");
        strcat(joined, cells[i]);
    }
    assert_string_equal(joined, expected);
}

static void divides_lines(void **state)
{
    (void)state;
    divides("a,b,c", ',', "|a|b|c", 3);
    divides(" a , b\t,c ", ',', "|a|b|c", 3);
    divides("a;;c;;", ';', "|a||c||", 3);
    divides("", ';', "|", 0);
    divides(";", ';', "||", 0);
    divides("\ta\t b", '\t', "||a|b", 3);
    divides("  0.1 \t 0.2  0.3 ", ' ', "|0.1|0.2|0.3", 3);
    divides("1,5;2", ';', "|1,5|2", 2);
}

static void divides_quoted_cells(void **state)
{
    (void)state;
    divides("\"a\",\"b\"", ',', "|a|b", 2);
    divides("\"0,2\", \"0,7\" ,x", ',', "|0,2|0,7|x", 3);
    divides("\"speed \"\"v\"\"\",b", ',', "|speed \"v\"|b", 2);
    divides("\"\",\"\"\"\"", ',', "||\"", 2);
    divides("\" a b \" c", ' ', "| a b|c", 2);
    /* a quote that nothing closes is text, as is one inside of a cell */
    divides("\"a,b", ',', "|\"a|b", 2);
    divides("\"a\"b,c", ',', "|\"a\"b|c", 2);
    divides("5\" rod,c", ',', "|5\" rod|c", 2);
}

static void stores_no_more_than_there_is_room_for(void **state)
{
    (void)state;
    char line[] = "a,b,c,d", *cells[3] = {NULL, NULL, NULL};
    size_t all;
    assert_int_equal(divide_line(line, ',', cells, 2, &all), 4);
    assert_int_equal(all, 4);
    assert_null(cells[2]);
}

static void knows_missing_readings(void **state)
{
    (void)state;
    static const char *const missing[] = {"", "-", "NaN", "n/a", "NA", "#NV", "#N/A", "null"};
    static const char *const there[] = {"0", "x", "- 1", "inf", "nano", "-1"};
    for (size_t i = 0; i < COUNT(missing); i++)
        assert_true(cell_is_missing(missing[i]));
    for (size_t i = 0; i < COUNT(there); i++)
        assert_false(cell_is_missing(there[i]));
}

static void reads_decimal_marks(void **state)
{
    (void)state;
    char number[CELL_SIZE], longest[CELL_SIZE + 1];
    assert_true(cell_with_point("-1,5e-3", number));
    assert_string_equal(number, "-1.5e-3");
    assert_true(cell_with_point("1.5", number));
    assert_string_equal(number, "1.5");
    assert_false(cell_with_point("1.234,5", number));
    memset(longest, '1', CELL_SIZE);
    longest[CELL_SIZE] = '\0';
    assert_false(cell_with_point(longest, number));
    assert_true(cell_mark("1,5") == ',' && cell_mark("+.5") == '.' && cell_mark("15") == '\0');
    /* that of a number, not of what follows it */
    assert_true(cell_mark("5 N.s") == '\0');
    assert_true(cell_begins_with_number("0,3 mm/s") && cell_begins_with_number("-.5"));
    assert_false(cell_begins_with_number("mm/s") || cell_begins_with_number("") ||
                 cell_begins_with_number("-"));
}

static void compares_names(void **state)
{
    (void)state;
    assert_true(cell_same_name("Sub-Impacts", "sub_impacts"));
    assert_true(cell_same_name("FIRST IMPULSE", "first_impulse"));
    assert_true(cell_same_name("SubImpacts", "sub_impacts"));
    assert_false(cell_same_name("speed", "speeds"));
    assert_false(cell_same_name("speeds", "speed"));
    assert_false(cell_same_name("", "at"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(divides_lines),
        cmocka_unit_test(divides_quoted_cells),
        cmocka_unit_test(stores_no_more_than_there_is_room_for),
        cmocka_unit_test(knows_missing_readings),
        cmocka_unit_test(reads_decimal_marks),
        cmocka_unit_test(compares_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
