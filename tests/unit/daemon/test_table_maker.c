/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/table_maker.c: who may have tables computed, and until when. */
#include <string.h>

#include "check.h"
#include "daemon/table_maker.h"

static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct material soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
static const struct contact_pair pair = {&steel, &soft, {1.0 / 0.03, 1.0 / 0.03}};
static const uint8_t client[16] = {7};

/* No tables are there; a computation that begins ends at the first look at `draining`. */
struct world {
    struct shared shared;
    struct table_maker maker;
    percuss_v1_Request request; /* names no client, as members of a batch may */
};

static const struct contact_table_source *begin(struct world *world)
{
    return table_maker_begin(&world->maker, &world->shared.tables, &world->request, client, 0.0);
}

static void open_world(struct world *world, bool draining)
{
    static const struct reply_limits limits = {
        .per_client = 4, .bytes = 1 << 20, .clients = 4, .seconds = 60.0};
    memset(world, 0, sizeof *world);
    atomic_init(&world->shared.draining, draining);
    activity_create(&world->shared.activity);
    world->shared.replies = reply_store_create(&limits);
    assert_non_null(world->shared.replies);
    assert_true(table_cache_create(&world->shared.tables, ""));
    world->request.options.contact_model = PERCUSS_CONTACT_TABLE;
    table_maker_init(&world->maker, &world->shared, true);
    begin(world);
}

static void close_world(struct world *world)
{
    table_cache_release(&world->shared.tables);
    reply_store_free(world->shared.replies);
    activity_release(&world->shared.activity);
}

static const struct contact_curves *find(struct world *world)
{
    const struct contact_table_source *source = &world->maker.source;
    return source->find(source->context, &pair);
}

/* The tables of the start are enough for whoever leaves the choice. */
static void who_does_not_insist_gets_what_is_there(void **state)
{
    (void)state;
    struct world world;
    open_world(&world, true);
    assert_ptr_equal(begin(&world), &world.maker.source);
    world.request.options.contact_model = PERCUSS_CONTACT_AUTO;
    const struct contact_table_source *source = begin(&world);
    assert_ptr_equal(source, table_store_source(world.shared.tables.loaded));
    assert_null(source->find(source->context, &pair));
    assert_int_equal(world.maker.status, PERCUSS_OK);
    close_world(&world);
}

/* Several threads may ask then. */
static void who_only_finds_computes_nothing(void **state)
{
    (void)state;
    struct world world;
    open_world(&world, true);
    assert_null(find(&world));
    assert_int_equal(world.maker.status, PERCUSS_BUSY);
    begin(&world);
    table_maker_only_finds(&world.maker);
    assert_null(find(&world));
    assert_int_equal(world.maker.status, PERCUSS_OK);
    close_world(&world);
}

/* The one who asked, whatever the request says of itself. */
static void the_computation_ends_when_its_client_goes(void **state)
{
    (void)state;
    struct world world;
    open_world(&world, false);
    reply_store_set_present(world.shared.replies, client, true, 0.0);
    reply_store_set_present(world.shared.replies, client, false, 0.0);
    assert_null(find(&world));
    assert_int_equal(world.maker.status, PERCUSS_TIMEOUT);
    assert_string_equal(world.maker.fault.text, "the client had gone: ask again");
    close_world(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_does_not_insist_gets_what_is_there),
        cmocka_unit_test(who_only_finds_computes_nothing),
        cmocka_unit_test(the_computation_ends_when_its_client_goes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
