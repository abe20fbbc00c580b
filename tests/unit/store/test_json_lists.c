/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/store/json_lists.c: its numbers are jansson's to the last bit, and what it does
 * not read jansson does. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "store/json_lists.h"

/* Parses a copy; how many of its lists were taken out. */
static size_t parse(const char *text, char **copy, struct json_lists *lists, json_t **root,
                    struct fault *fault)
{
    *copy = strdup(text);
    assert_non_null(*copy);
    json_lists_parse(*copy, strlen(text), lists, root, fault);
    return lists->count;
}

/* The list `a` of a text as jansson alone reads it; compared bit by bit. */
static void same_as_alone(const char *text, size_t taken)
{
    char *copy;
    struct json_lists lists;
    struct fault fault = {""}, other = {""};
    json_t *root, *alone;
    size_t count = 0, expected = 0;
    double *values = NULL, *whole = NULL;
    size_t found = parse(text, &copy, &lists, &root, &fault);
    if (found != taken)
        fail_msg("%zu lists taken out of %s", found, text);
    enum percuss_status status = json_numbers_parse(text, strlen(text), &alone, &other);
    assert_int_equal(root == NULL, alone == NULL);
    if (!status) {
        status =
            json_numbers_take_array(json_object_get(alone, "a"), "a", &expected, &whole, &other);
        assert_int_equal(json_lists_take(&lists, root, "a", &count, &values, &fault), status);
    }
    if (!status) {
        assert_int_equal(count, expected);
        assert_memory_equal(values, whole, count * sizeof *values);
    }
    assert_string_equal(fault.text, other.text);
    free(values);
    free(whole);
    json_decref(root);
    json_decref(alone);
    json_lists_free(&lists);
    free(copy);
}

static void plain_lists_are_taken_out(void **state)
{
    (void)state;
    same_as_alone("{\"a\":[1,-2,0,0.5,1.5e-7,12345678.9012345,1E+22,3e-05,0.006030511]}", 1);
    same_as_alone("{\"b\":[3],\"a\":[ 1 ,\t2.25\n, 3 ]\n,\"c\":{\"a\":[4]}}", 2);
    same_as_alone("{\"c\":{\"a\":[4]},\"s\":\"\\\"a\\\":[1]\",\"a\":[5]}", 1);
}

static void other_lists_are_left_in(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "{\"a\":[1234567890123456]}",
        "{\"a\":[0.1234567890123456]}",
        "{\"a\":[1e23]}",
        "{\"a\":[1e-300]}",
        "{\"a\":[-0]}",
        "{\"a\":[-0.0]}",
        "{\"a\":[]}",
        "{\"a\":[1,[2]]}",
        "{\"a\":[1,true]}",
        "{\"a\":[\"1\"]}",
        "{\"\\u0061\":[1]}",
        "{\"a\" : [1]}",
        "[[1]]",
        "{\"a\":1}",
    };
    for (size_t i = 0; i < COUNT(texts); i++)
        same_as_alone(texts[i], 0);
}

/* With jansson's message, which names the line. */
static void what_is_not_json_is_refused(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "{\"a\":[01]}", "{\"a\":[1.]}",  "{\"a\":[.5]}",    "{\"a\":[1e]}",  "{\"a\":[1,]}",
        "{\"a\":[+1]}", "{\"a\":[1 2]}", "{\"a\":[1",       "{\"a\":[0x1]}", "{\"a\":[-]}",
        "{\"a",         "{\"a\\",        "{\"a\":[1e400]}", "{\"a\":[nan]}", "",
    };
    for (size_t i = 0; i < COUNT(texts); i++)
        same_as_alone(texts[i], 0);
    same_as_alone("{\"a\":[1]", 1);
    same_as_alone("{\"a\":[1],\"a\":[2]}", 2);
    same_as_alone("{\"a\":[1],\"\\u0061\":[2]}", 1);
    same_as_alone("{\"a\":[1,\n2,\n3],\n\"b\":oops}", 1);
}

/* Of all digits and powers, and counts beyond one step of room. */
static void numbers_are_those_nearest(void **state)
{
    (void)state;
    unsigned short seed[3] = {7, 8, 9};
    static char text[40 * 1000];
    for (int round = 0; round < 50; round++) {
        int used = sprintf(text, "{\"a\":[");
        for (int i = 0; i < 1000; i++) {
            double value = exp(24.0 * erand48(seed) - 12.0);
            int digits = 1 + (int)(15.0 * erand48(seed));
            used += sprintf(text + used, "%s%.*g", i ? "," : "", digits, i % 3 ? value : -value);
        }
        strcpy(text + used, "]}");
        same_as_alone(text, 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_lists_are_taken_out),
        cmocka_unit_test(other_lists_are_left_in),
        cmocka_unit_test(what_is_not_json_is_refused),
        cmocka_unit_test(numbers_are_those_nearest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
