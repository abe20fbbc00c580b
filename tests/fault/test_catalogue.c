/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests catalogue/ on files that are cut off: the shipped catalogue at every octet. */
#include <stdio.h>
#include <string.h>

#include "catalogue/catalogue.h"
#include "check.h"

static const char SHIPPED[] = PERCUSS_SOURCE_DIR "/config/catalogue.yaml";

static char *read_all(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char *text = malloc(CATALOGUE_MAX_BYTES);
    assert_non_null(text);
    *size = fread(text, 1, CATALOGUE_MAX_BYTES, file);
    fclose(file);
    return text;
}

/* Reduced bodies are found from where the file is. */
static bool is_taken(const char *text, size_t size, struct body_set **set)
{
    struct fault fault;
    enum percuss_status status = catalogue_parse(text, size, SHIPPED, set, &fault);
    assert_true(!status || status == PERCUSS_BAD_REQUEST);
    return !status;
}

static void a_catalogue_that_is_cut_off(void **state)
{
    (void)state;
    size_t size;
    char *text = read_all(SHIPPED, &size);
    struct body_set *whole, *part;
    assert_true(is_taken(text, size, &whole));
    unsigned taken = 0;
    for (size_t cut = 0; cut < size; cut++) {
        if (!is_taken(text, cut, &part))
            continue;
        /* nothing but the last line's end is missing */
        assert_string_equal(part->revision, whole->revision);
        assert_true(cut == size - 1);
        body_set_free(part);
        taken++;
    }
    print_message("    cut at %zu places, taken at %u\n", size, taken);
    body_set_free(whole);
    free(text);
}

/* As catalogues were written before there were marks. */
static void marks_may_be_left_out(void **state)
{
    (void)state;
    static const char text[] = "materials:\n  m: {young: 1e9, poisson: 0.3, density: 1e3}\n"
                               "bodies:\n  b: {shape: sphere, material: m, radius: 0.01}\n";
    char marked[sizeof text + 32];
    struct body_set *set, *other;
    assert_true(is_taken(text, sizeof text - 1, &set));
    /* they change nothing that is answered */
    int size = snprintf(marked, sizeof marked, "begin: true\n%send: true\n", text);
    assert_true(is_taken(marked, (size_t)size, &other));
    assert_string_equal(set->revision, other->revision);
    body_set_free(other);
    size = snprintf(marked, sizeof marked, "%send: true\n", text);
    assert_false(is_taken(marked, (size_t)size, &other));
    size = snprintf(marked, sizeof marked, "begin: true\n%send: false\n", text);
    assert_false(is_taken(marked, (size_t)size, &other));
    body_set_free(set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_catalogue_that_is_cut_off),
        cmocka_unit_test(marks_may_be_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
