/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests the guard of catalogue/catalogue.c: text that is not YAML or uses more of YAML than a
 * catalogue needs. */
#include <stdlib.h>

#include "parse.h"

static void refuses_what_is_not_yaml(void **state)
{
    (void)state;
    parse_bad("", 1, "an empty file: must hold materials and bodies");
    parse_bad("# only a comment\n", 1, "an empty file");
    parse_bad("materials:\n  a: {young: 1\nbodies: 2\n", 3, "must be valid YAML");
    parse_bad("a: b\n\tc: d\n", 2, "must be valid YAML");
    parse_bad("a: b\nc: \xFF\n", 2, "must be UTF-8 text");
    parse_bad("a: b\n\nc: \x01\n", 3, "must be UTF-8 text without control characters");
    parse_bad("\xFF\xFE"
              "a",
              1, "must be UTF-8 text"); /* UTF-16 */
    parse_bad("a: 'b\n", 2, "must be valid YAML");
}

static void refuses_what_a_catalogue_does_not_need(void **state)
{
    (void)state;
    parse_bad("a: &x 1\n", 1, "anchors and aliases");
    parse_bad("a: &x {b: 1}\nc: *x\n", 1, "anchors and aliases");
    parse_bad("a: 1\nb: &x [1]\n", 2, "anchors and aliases");
    parse_bad("a: 1\nb: !!float 1\n", 2, "tags");
    parse_bad("a: !thing {b: 1}\n", 1, "tags");
    parse_bad("# x\n%TAG !e! tag:example.org,2000:\n---\na: 1\n", 2, "%TAG must not be used");
    parse_bad("a: 1\n---\nb: 1\n", 2, "a second document");
    parse_bad("a: [[[[[[[[1]]]]]]]]\n", 1, "nested too deeply");
}

static char *repeat(const char *word, size_t count)
{
    size_t length = strlen(word);
    char *text = malloc(count * length + 1);
    assert_non_null(text);
    for (size_t i = 0; i < count; i++)
        memcpy(text + i * length, word, length);
    text[count * length] = '\0';
    return text;
}

/* Each of these would take minutes or gigabytes if it were not stopped early. */
static void stops_hostile_texts_early(void **state)
{
    (void)state;
    static const char *const words[] = {"[", "{", "- ", "? ", "a: &a 1\n", "[\n", "!"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char *text = repeat(words[i], 1000000);
        struct body_set *set;
        struct fault fault;
        assert_int_equal(catalogue_parse(text, strlen(text), "x", &set, &fault),
                         PERCUSS_BAD_REQUEST);
        free(text);
    }
}

static void refuses_what_is_too_long(void **state)
{
    (void)state;
    struct body_set *set;
    struct fault fault;
    char *text = repeat("#", CATALOGUE_MAX_BYTES + 1);
    assert_int_equal(catalogue_parse(text, CATALOGUE_MAX_BYTES + 1, "x", &set, &fault),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "x: too long: must be at most 16777216 bytes"));
    free(text);
    text = repeat("- a\n", 3000001);
    parse_bad(text, 3000000, "too many values");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refuses_what_is_not_yaml),
        cmocka_unit_test(refuses_what_a_catalogue_does_not_need),
        cmocka_unit_test(stops_hostile_texts_early),
        cmocka_unit_test(refuses_what_is_too_long),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
