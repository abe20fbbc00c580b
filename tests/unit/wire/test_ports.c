/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* idl/wire_ports.c: which domains, and which participants of them, the ports of a host tell of.
 * That servers are found in them is shown in tests/service/ask/no_server.sh. */
#include "wire_ports.h"

#include <stdio.h>
#include <string.h>

#include "check.h"

static struct wire_ports ports;

/* Looks at a table as the kernel writes it. */
static void look(const char *lines, const struct wire_ports_owner *owner)
{
    char text[1024];
    int length = snprintf(text, sizeof text,
                          "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when "
                          "retrnsmt   uid  timeout inode ref pointer drops\n%s",
                          lines);
    assert_true(length > 0 && (size_t)length < sizeof text);
    FILE *table = fmemopen(text, (size_t)length, "r");
    assert_non_null(table);
    wire_ports_read(table, owner, &ports);
    fclose(table);
}

static size_t count_domains(void)
{
    size_t count = 0;
    for (uint32_t domain = 0; domain < WIRE_PORTS_DOMAINS; domain++)
        count += wire_ports_have(&ports, domain);
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
    (void)state;
    look(lines, NULL);
    assert_true(wire_ports_have(&ports, 0) && wire_ports_have(&ports, 7) &&
                wire_ports_have(&ports, 21));
    assert_int_equal(count_domains(), 3);
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
    (void)state;
    look(lines, NULL);
    assert_int_equal(count_domains(), 0);
    look("", NULL);
    assert_int_equal(count_domains(), 0);
}

/* Participants 0 and 1 of domain 20 (12410 to 12413), one port of 2, and 4: 3 of them keep others
 * from an index, the first gap is 3. */
static const char *const INDICES =
    " 1: 00000000:307A 00000000:0000 07 00000000:00000000 00:00000000 00000000  7  0 11 2\n"
    " 2: 00000000:307B 00000000:0000 07 00000000:00000000 00:00000000 00000000  7  0 12 2\n"
    " 3: 00000000:307C 00000000:0000 07 00000000:00000000 00:00000000 00000000  8  0 13 2\n"
    " 4: 00000000:307D 00000000:0000 07 00000000:00000000 00:00000000 00000000  8  0 14 2\n"
    " 5: 00000000:307F 00000000:0000 07 00000000:00000000 00:00000000 00000000  7  0 15 2\n"
    " 6: 00000000:3082 00000000:0000 07 00000000:00000000 00:00000000 00000000  7  0 16 2\n";

static void test_indices_are_counted_to_the_first_gap(void **state)
{
    (void)state;
    look(INDICES, NULL);
    assert_int_equal(wire_ports_indices(&ports, 20, 0), 3);
    assert_int_equal(wire_ports_indices(&ports, 20, 2), 1);
    assert_int_equal(wire_ports_indices(&ports, 20, 3), 0);
    assert_int_equal(wire_ports_indices(&ports, 21, 0), 0);
    assert_int_equal(wire_ports_of_index(20, 3), 12416);
}

/* By its sockets, or by its user where those may not be read. */
static void test_ports_of_an_owner(void **state)
{
    static const unsigned long sockets[] = {13, 14};
    (void)state;
    look(INDICES, &(struct wire_ports_owner){.user = 7});
    assert_true(wire_ports_have(&ports, 20));
    assert_false(ports.bound[12412]);
    look(INDICES, &(struct wire_ports_owner){.sockets = sockets, .socket_count = 2});
    assert_true(wire_ports_have(&ports, 20));
    assert_false(ports.bound[12410]);
    look(INDICES, &(struct wire_ports_owner){.user = 9});
    assert_int_equal(count_domains(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs_of_ports_are_domains),
        cmocka_unit_test(test_other_ports_are_none),
        cmocka_unit_test(test_indices_are_counted_to_the_first_gap),
        cmocka_unit_test(test_ports_of_an_owner),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
