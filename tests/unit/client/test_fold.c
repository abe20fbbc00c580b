/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/fold.c: where a line is broken. */

#include "fold.h"

#include <string.h>

#include "check.h"

static void check_place(const char *line, size_t width, const char *rest, size_t indent)
{
    size_t next, by;
    size_t place = fold_place(line, strlen(line), width, &next, &by);
    assert_true(place <= width);
    assert_int_equal(strspn(line + place, " "), next - place);
    assert_string_equal(line + next, rest);
    assert_int_equal(by, indent);
}

static void breaks_between_columns_and_words(void **state)
{
    (void)state;
    /* columns of numbers, whose head has words with single blanks */
    check_place("   0.1   0.281451   7.5184  OK", 24, "7.5184  OK", 4);
    check_place("   v/s   e no 1      end ms  status", 24, "end ms  status", 4);
    /* a text behind columns goes on below its beginning */
    check_place("al-beam  beam  a beam of one metre", 27, "one metre", 15);
    /* words */
    check_place("one two three four", 13, "four", 4);
}

static void leaves_what_has_no_place(void **state)
{
    (void)state;
    size_t next, indent;
    assert_int_equal(fold_place("12345678901234567890", 20, 10, &next, &indent), 20);
    assert_int_equal(fold_place("    1234567890123456", 20, 10, &next, &indent), 20);
    /* nothing but blanks is too much */
    assert_int_equal(fold_place("12345678            ", 20, 10, &next, &indent), 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(breaks_between_columns_and_words),
        cmocka_unit_test(leaves_what_has_no_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
