/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* client/cli/domains.c: which domains the ports of a host tell of. That servers are found in them
 * is shown in tests/service/ask/no_server.sh. */
#include "domains.h"

#include <stdio.h>
#include <string.h>

#include "check.h"

/* Looks at a table as the kernel writes it. */
static void look(const char *lines, bool taken[DOMAINS_COUNT])
{
    char text[1024];
    int length = snprintf(text, sizeof text,
                          "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when "
                          "retrnsmt   uid  timeout inode ref pointer drops\n%s",
                          lines);
    assert_true(length > 0 && (size_t)length < sizeof text);
    FILE *table = fmemopen(text, (size_t)length, "r");
    assert_non_null(table);
    domains_by_ports(table, taken);
    fclose(table);
}

static size_t count_taken(const bool taken[DOMAINS_COUNT])
{
    size_t count = 0;
    for (size_t i = 0; i < DOMAINS_COUNT; i++)
        count += taken[i];
    return count;
}

/* 7410 and 7411: the first process of domain 0. 7400 + 250 * 7 + 10 + 2 * 100 and the next one: the
 * last of domain 7. 7400 + 250 * 21, and the next one: multicast of domain 21. */
static void test_pairs_of_ports_are_domains(void **state)
{
    static const char *lines =
        " 4696: 0100007F:1CF2 00000000:0000 07 00000000:00000000 00:00000000 00000000  0  0 1 2\n"
        "13075: 00000000:1CF3 00000000:0000 07 00000000:00000000 00:00000000 00000000  0  0 2 2\n"
        "  75: 00000000:2490 00000000:0000 07 00000000:00000000 00:00000000 00000000  0  0 3 2\n"
        "  76: 00000000:2491 00000000:0000 07 00000000:00000000 00:00000000 00000000  0  0 4 2\n"
        "  77: 00000000:316A 00000000:0000 07 00000000:00000000 00:00000000 00000000  0  0 5 2\n"
        "  78: 00000000:316B 00000000:0000 07 00000000:00000000 00:00000000 00000000  0  0 6 2\n";
    bool taken[DOMAINS_COUNT];
    (void)state;
    look(lines, taken);
    assert_true(taken[0] && taken[7] && taken[21]);
    assert_int_equal(count_taken(taken), 3);
}

/* One of a pair; an odd port and the even one after it; below and above what domains have. */
static void test_other_ports_are_none(void **state)
{
    static const char *lines = " 1: 00000000:1CF2 00000000:0000 07\n"
                               " 2: 00000000:2491 00000000:0000 07\n"
                               " 3: 00000000:2492 00000000:0000 07\n"
                               " 4: 00000000:0044 00000000:0000 07\n"
                               " 5: 00000000:0045 00000000:0000 07\n"
                               " 6: 00000000:FFFE 00000000:0000 07\n"
                               " 7: 00000000:FFFF 00000000:0000 07\n"
                               "no line of a table\n";
    bool taken[DOMAINS_COUNT];
    (void)state;
    look(lines, taken);
    assert_int_equal(count_taken(taken), 0);
    look("", taken);
    assert_int_equal(count_taken(taken), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs_of_ports_are_domains),
        cmocka_unit_test(test_other_ports_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
