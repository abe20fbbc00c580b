/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/shared.c: until when a contact table is computed, and what the status says of it. */
#include "daemon/shared.h"

#include <string.h>

#include "check.h"

static const uint8_t client[16] = {7};

static void open_world(struct shared *shared, struct table_maker *maker)
{
    static const struct reply_limits limits = {
        .per_client = 4, .bytes = 1 << 20, .clients = 4, .seconds = 60.0};
    memset(shared, 0, sizeof *shared);
    memset(maker, 0, sizeof *maker);
    activity_create(&shared->activity);
    shared->replies = reply_store_create(&limits);
    assert_non_null(shared->replies);
    maker->client = client;
}

static void close_world(struct shared *shared)
{
    reply_store_free(shared->replies);
    activity_release(&shared->activity);
}

static void tells_how_far_it_is(void **state)
{
    (void)state;
    struct shared shared;
    struct table_maker maker;
    struct fault fault;
    char text[128];
    double progress;
    open_world(&shared, &maker);
    assert_int_equal(shared_table_goes_on(&shared, &maker, 0.25, &fault), PERCUSS_OK);
    activity_read(&shared.activity, text, sizeof text, &progress);
    assert_string_equal(text, "computing a contact table");
    assert_true(progress == 0.25);
    shared_table_ended(&shared, &maker);
    activity_read(&shared.activity, text, sizeof text, &progress);
    assert_string_equal(text, "");
    close_world(&shared);
}

/* The one who asked, whatever the request says of itself. */
static void ends_when_its_client_goes(void **state)
{
    (void)state;
    struct shared shared;
    struct table_maker maker;
    struct fault fault;
    open_world(&shared, &maker);
    reply_store_set_present(shared.replies, client, true, 0.0);
    assert_int_equal(shared_table_goes_on(&shared, &maker, 0.5, &fault), PERCUSS_OK);
    reply_store_set_present(shared.replies, client, false, 0.0);
    assert_int_equal(shared_table_goes_on(&shared, &maker, 0.5, &fault), PERCUSS_TIMEOUT);
    assert_string_equal(fault.text, "the client had gone: ask again");
    close_world(&shared);
}

static void ends_when_the_server_does(void **state)
{
    (void)state;
    struct shared shared;
    struct table_maker maker;
    struct fault fault;
    open_world(&shared, &maker);
    atomic_store(&shared.draining, true);
    assert_int_equal(shared_table_goes_on(&shared, &maker, 0.5, &fault), PERCUSS_BUSY);
    assert_string_equal(fault.text, SHARED_SHUTTING_DOWN);
    close_world(&shared);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tells_how_far_it_is),
        cmocka_unit_test(ends_when_its_client_goes),
        cmocka_unit_test(ends_when_the_server_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
