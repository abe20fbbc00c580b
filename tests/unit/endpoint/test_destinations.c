/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests the destinations of endpoint/reply_writers.c: a writer for each client and channel as long
 * as a reader exists. */
#include <string.h>

#include "check.h"
#include "endpoint/reply_writers.h"

/* Writers are numbered as they are made. */
static dds_entity_t number_writer(void *made, const uint8_t client[16], unsigned channel)
{
    (void)client, (void)channel;
    return ++*(dds_entity_t *)made;
}

static void sum_writers(void *sum, dds_entity_t writer)
{
    *(int *)sum += writer;
}

static struct digest key_of(uint64_t number)
{
    return (struct digest){number, 0};
}

static const uint8_t one[16] = {1}, other[16] = {2};

/* A reader of a participant of its own. */
static bool add(struct destinations *destinations, uint64_t key, const uint8_t client[16],
                unsigned channel)
{
    struct destination_reader reader = {key_of(key), key_of(100 + key), client, channel};
    return destinations_add(destinations, &reader);
}

static void one_participant_leaves_places_to_others(void **state)
{
    (void)state;
    dds_entity_t made = 0;
    uint8_t client[16] = {0};
    struct destinations *destinations = destinations_create(4, number_writer, &made);
    struct destination_reader reader = {.participant = key_of(7), .client = client};
    for (uint8_t i = 1; i <= 4; i++) {
        reader.key = key_of(client[0] = i);
        assert_int_equal(destinations_add(destinations, &reader), i <= 2);
    }
    /* more readers of the clients it has take no place */
    reader.key = key_of(client[0] = 2);
    reader.key.second = 1;
    assert_true(destinations_add(destinations, &reader));
    /* newcomers, as long as there are places */
    for (uint8_t i = 5; i <= 7; i++) {
        client[0] = i;
        assert_int_equal(add(destinations, i, client, 0), i <= 6);
    }
    assert_int_equal(destinations_count(destinations), 4);
    destinations_free(destinations);
}

static void a_writer_lives_as_long_as_its_readers(void **state)
{
    (void)state;
    enum delivery delivery;
    uint8_t client[16];
    dds_entity_t made = 0;
    struct destinations *destinations = destinations_create(4, number_writer, &made);
    assert_int_equal(destinations_writer(destinations, one, 0, &delivery), 0);
    assert_int_equal(delivery, DELIVERY_NO_READER);
    /* two readers of one channel share a writer */
    assert_true(add(destinations, 1, one, 0));
    assert_true(add(destinations, 2, one, 0));
    assert_true(add(destinations, 3, one, CHANNEL_TRACE));
    assert_true(add(destinations, 4, other, 0));
    assert_int_equal(made, 3);
    assert_int_equal(destinations_count(destinations), 2);
    assert_int_equal(destinations_writer(destinations, one, 0, &delivery), 1);
    assert_int_equal(delivery, DELIVERY_DONE);
    int sum = 0;
    destinations_visit(destinations, sum_writers, &sum);
    assert_int_equal(sum, 1 + 2 + 3);
    /* the last one of them gives it back */
    assert_int_equal(destinations_remove(destinations, key_of(1), client), 0);
    assert_memory_equal(client, one, sizeof one);
    assert_false(destinations_know(destinations, key_of(1)));
    assert_true(destinations_know(destinations, key_of(2)));
    assert_int_equal(destinations_remove(destinations, key_of(2), client), 1);
    assert_int_equal(destinations_writer(destinations, one, 0, &delivery), 0);
    assert_int_equal(destinations_writer(destinations, one, CHANNEL_TRACE, &delivery), 2);
    /* and with the last channel the client goes */
    assert_int_equal(destinations_remove(destinations, key_of(3), client), 2);
    assert_int_equal(destinations_count(destinations), 1);
    destinations_free(destinations);
}

static void who_stalls_is_left_alone_on_that_channel(void **state)
{
    (void)state;
    enum delivery delivery;
    dds_entity_t made = 0;
    struct destinations *destinations = destinations_create(4, number_writer, &made);
    assert_true(add(destinations, 1, one, 0));
    assert_true(add(destinations, 2, one, 1));
    destinations_stall(destinations, one, 0);
    destinations_stall(destinations, other, 0); /* is not there */
    assert_int_equal(destinations_writer(destinations, one, 0, &delivery), 0);
    assert_int_equal(delivery, DELIVERY_STALLED);
    assert_int_equal(destinations_writer(destinations, one, 1, &delivery), 2);
    assert_int_equal(delivery, DELIVERY_DONE);
    destinations_free(destinations);
}

enum { MOST = 1024 };

static void too_many_clients_are_refused(void **state)
{
    (void)state;
    dds_entity_t made = 0;
    struct destinations *destinations = destinations_create(MOST, number_writer, &made);
    uint8_t client[16] = {0};
    for (uint32_t i = 0; i <= MOST; i++) {
        memcpy(client, &i, sizeof i);
        assert_int_equal(add(destinations, i, client, 0), i < MOST);
    }
    /* a channel more of one that is there is none too many */
    memset(client, 0, sizeof client);
    assert_true(add(destinations, MOST + 1, client, 1));
    assert_int_equal(destinations_count(destinations), MOST);
    destinations_free(destinations);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_participant_leaves_places_to_others),
        cmocka_unit_test(a_writer_lives_as_long_as_its_readers),
        cmocka_unit_test(who_stalls_is_left_alone_on_that_channel),
        cmocka_unit_test(too_many_clients_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
