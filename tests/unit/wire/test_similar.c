/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests idl/percuss/similar.h: which id was meant. */
#include <string.h>

#include "check.h"
#include "percuss/similar.h"

static void measures_the_distance(void **state)
{
    (void)state;
    assert_int_equal(similar_distance("", ""), 0);
    assert_int_equal(similar_distance("al-rod", "al-rod"), 0);
    assert_int_equal(similar_distance("", "rod"), 3);
    assert_int_equal(similar_distance("rod", ""), 3);
    assert_int_equal(similar_distance("kitten", "sitting"), 3);
    assert_int_equal(similar_distance("al-rod", "al-rod-1"), 2);
    /* swapped letters are one mistake; what stands between them is not passed over */
    assert_int_equal(similar_distance("cvs", "csv"), 1);
    assert_int_equal(similar_distance("ab", "ba"), 1);
    assert_int_equal(similar_distance("qurey", "query"), 1);
    assert_int_equal(similar_distance("ca", "abc"), 3);
}

static const char *meant(const char *word)
{
    static const char *const names[] = {"al-beam", "al-rod", "steel-sphere"};
    struct similar similar = similar_to(word);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        similar_offer(&similar, names[i]);
    return similar.nearest;
}

static void finds_what_was_meant(void **state)
{
    (void)state;
    assert_string_equal(meant("steel-spere"), "steel-sphere");
    assert_string_equal(meant("al_rod"), "al-rod");
    assert_null(meant("concrete-wall"));
    assert_null(meant(""));
    /* longer than any id */
    char text[200];
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    assert_int_equal(similar_distance(text, "x"), SIMILAR_SIZE - 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(measures_the_distance),
        cmocka_unit_test(finds_what_was_meant),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
