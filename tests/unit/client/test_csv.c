/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/csv.c: units of columns, quotes of texts. */

#include "csv.h"

#include <stdlib.h>

#include "check.h"

/* What is written is `expected`. */
static void check_written(char **text, FILE *file, const char *expected)
{
    assert_int_equal(fclose(file), 0);
    assert_string_equal(*text, expected);
    free(*text);
    *text = NULL;
}

static void units_stand_behind_what_has_some(void **state)
{
    (void)state;
    static const char names[] = "speed,young@al-beam,restitution,simulated_first_impulse,"
                                "simulated_restitution,speeds,end_time";
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    csv_head(file, names, false);
    check_written(&text, file, names);
    file = open_memstream(&text, &size);
    csv_head(file, names, true);
    check_written(&text, file,
                  "speed [m/s],young@al-beam [Pa],restitution,simulated_first_impulse [N s],"
                  "simulated_restitution,speeds,end_time [s]");
}

static void texts_are_quoted_where_they_need_it(void **state)
{
    (void)state;
    static const char *const texts[][2] = {{"al-beam", "al-beam"},
                                           {"", ""},
                                           {"length 1 m, radius 2 m", "\"length 1 m, radius 2 m\""},
                                           {"a \"b\"", "\"a \"\"b\"\"\""},
                                           {"two\nlines", "\"two\nlines\""}};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char *text = NULL;
        size_t size;
        FILE *file = open_memstream(&text, &size);
        csv_text(file, texts[i][0]);
        check_written(&text, file, texts[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_stand_behind_what_has_some),
        cmocka_unit_test(texts_are_quoted_where_they_need_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
