/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* idl/wire_loopback.c: whose sockets get a filter. That it keeps others out is shown in
 * tests/service/security/this_machine_only.sh. */
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "check.h"
#include "domain.h"
#include "wire.h"
#include "wire_loopback.h"

enum { MOST_FILES = 256 };

static uint32_t domain;

static int choose_domain(void **state)
{
    (void)state;
    domain = domain_draw();
    return 0;
}

/* Instructions of its filter; -1: no socket. */
static int filter_length(int file)
{
    socklen_t length = 0;
    return getsockopt(file, SOL_SOCKET, SO_GET_FILTER, NULL, &length) == 0 ? (int)length : -1;
}

static int count_filtered(void)
{
    int count = 0;
    for (int file = 0; file < MOST_FILES; file++)
        count += filter_length(file) > 0;
    return count;
}

static void the_domain_is_closed_and_nothing_else(void **state)
{
    (void)state;
    /* as another DDS library in this process would have: a port of the domain, of process 50 */
    int other = socket(AF_INET, SOCK_DGRAM, 0);
    struct sockaddr_in address = {.sin_family = AF_INET,
                                  .sin_port = htons((uint16_t)(7400 + 250 * domain + 10 + 2 * 50)),
                                  .sin_addr = {htonl(INADDR_ANY)}};
    assert_int_equal(bind(other, (struct sockaddr *)&address, sizeof address), 0);
    dds_entity_t created = wire_loopback_create(domain, WIRE_SERVER);
    assert_true(created > 0);
    assert_int_equal(filter_length(other), 0);
    /* announcements and data */
    assert_int_equal(count_filtered(), 2);
    assert_int_equal(wire_loopback_create(domain, WIRE_SERVER), DDS_RETCODE_PRECONDITION_NOT_MET);
    assert_int_equal(dds_delete(created), DDS_RETCODE_OK);
    close(other);
}

static void participants_share_it(void **state)
{
    (void)state;
    dds_entity_t first = wire_participant_create(domain), second = wire_participant_create(domain);
    assert_true(first > 0 && second > 0);
    assert_int_equal(dds_get_parent(first), dds_get_parent(second));
    assert_int_equal(count_filtered(), 2);
    dds_entity_t elsewhere = wire_participant_create(domain_draw());
    assert_true(elsewhere > 0);
    assert_int_equal(count_filtered(), 4);
    dds_delete(dds_get_parent(elsewhere));
    dds_delete(dds_get_parent(first));
}

/* Ports of a client lie behind those that clients announce themselves to: no two of them meet. */
static void clients_are_behind_the_servers(void **state)
{
    (void)state;
    int seen = 0;
    dds_entity_t participant = wire_participant_create_client(domain, NULL);
    assert_true(participant > 0);
    for (int file = 0; file < MOST_FILES; file++) {
        struct sockaddr_in address;
        socklen_t size = sizeof address;
        if (filter_length(file) <= 0 || getsockname(file, (struct sockaddr *)&address, &size) != 0)
            continue;
        assert_true(ntohs(address.sin_port) >= 7400 + 250 * domain + 10 + 2 * 16);
        assert_true(ntohs(address.sin_port) < 7400 + 250 * (domain + 1));
        seen++;
    }
    assert_int_equal(seen, 2);
    dds_delete(dds_get_parent(participant));
}

int main(void)
{
    unsetenv("CYCLONEDDS_URI");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_domain_is_closed_and_nothing_else),
        cmocka_unit_test(participants_share_it),
        cmocka_unit_test(clients_are_behind_the_servers),
    };
    return cmocka_run_group_tests(tests, choose_domain, NULL);
}
