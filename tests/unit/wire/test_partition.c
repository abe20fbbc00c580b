/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* idl/wire_partition.c: names of partitions, and those of replies in them. */
#include "wire_partition.h"

#include <string.h>

#include "check.h"

/* DDS takes '*', '?' and '[' for patterns; 63 characters are the most. */
static void test_what_is_a_name(void **state)
{
    static const char *good[] = {"gears", "a", "Rig-3_b.2", "c_0"};
    static const char *bad[] = {"", "a b", "a/b", "*", "gear?", "[a-z]", "gr\303\266sse"};
    char longest[WIRE_PARTITION_SIZE + 1];
    (void)state;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_true(wire_partition_is_good(good[i]));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(wire_partition_is_good(bad[i]));
    memset(longest, 'x', sizeof longest);
    longest[WIRE_PARTITION_SIZE] = '\0';
    assert_false(wire_partition_is_good(longest));
    longest[WIRE_PARTITION_SIZE - 1] = '\0';
    assert_true(wire_partition_is_good(longest));
}

/* Version 0.1.0 knows a client's partition by its 34 characters. */
static void test_where_replies_go(void **state)
{
    static const uint8_t client[16] = {0x00, 0x01, [14] = 0xab, 0xff};
    static const char plain[] = "c_0001000000000000000000000000abff";
    char name[WIRE_REPLIES_SIZE], longest[WIRE_PARTITION_SIZE];
    (void)state;
    wire_partition_of_replies(client, NULL, name);
    assert_string_equal(name, plain);
    wire_partition_of_replies(client, "", name);
    assert_string_equal(name, plain);
    wire_partition_of_replies(client, "gears", name);
    assert_string_equal(name, "c_0001000000000000000000000000abff.gears");
    /* the longest one is whole */
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    wire_partition_of_replies(client, longest, name);
    assert_int_equal(strlen(name), WIRE_REPLIES_SIZE - 1);
    assert_string_equal(name + sizeof plain, longest);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_a_name),
        cmocka_unit_test(test_where_replies_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
