/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api/similar.c: which id was meant, as percuss_body_find says it, too. */
#include <string.h>

#include "check.h"
#include "similar.h"

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

static void finds_what_was_meant(void **state)
{
    (void)state;
    struct percuss_body bodies[] = {{.id = "al-beam"}, {.id = "al-rod"}, {.id = "steel-sphere"}};
    const struct percuss_body_list list = {3, bodies};
    assert_ptr_equal(similar_body(&list, "steel-spere"), &bodies[2]);
    assert_ptr_equal(similar_body(&list, "al_rod"), &bodies[1]);
    assert_null(similar_body(&list, "concrete-wall"));
    assert_null(similar_body(&list, ""));
    /* longer than any id */
    char text[200];
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    assert_int_equal(similar_distance(text, "x"), PERCUSS_ID_SIZE - 2);
}

static void tells_what_is_similar(void **state)
{
    (void)state;
    struct percuss_body bodies[] = {{.id = "al-beam"}, {.id = "al-rod"}};
    const struct percuss_body_list list = {2, bodies};
    assert_null(percuss_body_find(&list, "al-rodd"));
    assert_string_equal(percuss_error_text(),
                        "id: 'al-rodd': no such body among 2; did you mean 'al-rod'?");
    assert_null(percuss_body_find(&list, "concrete-wall"));
    assert_string_equal(percuss_error_text(), "id: 'concrete-wall': no such body among 2");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(measures_the_distance),
        cmocka_unit_test(finds_what_was_meant),
        cmocka_unit_test(tells_what_is_similar),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
