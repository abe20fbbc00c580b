/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests respond/table_maker.c: who may have tables computed, and until when. */
#include <string.h>

#include "check.h"
#include "respond/table_maker.h"

static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct material soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
static const struct contact_pair pair = {&steel, &soft, {1.0 / 0.03, 1.0 / 0.03}};
static const uint8_t client[16] = {7};

/* No tables are there; a computation that begins ends at the first look whether it is wanted. */
struct world {
    struct table_cache tables;
    struct table_maker maker;
    percuss_v1_Request request; /* names no client, as members of a batch may */
    unsigned looks;
    bool has_ended;
};

static enum percuss_status give_up(void *context, const struct table_maker *maker, double done,
                                   struct fault *fault)
{
    struct world *world = context;
    world->looks++;
    assert_ptr_equal(maker, &world->maker);
    assert_memory_equal(maker->client, client, sizeof client);
    assert_true(done >= 0.0 && done <= 1.0);
    return fault_set(fault, PERCUSS_BUSY, "nobody waits");
}

static void note_end(void *context, const struct table_maker *maker)
{
    struct world *world = context;
    assert_ptr_equal(maker, &world->maker);
    world->has_ended = true;
}

static const struct contact_table_source *begin(struct world *world)
{
    return table_maker_begin(&world->maker, &world->tables, &world->request, client, 0.0);
}

static void open_world(struct world *world, bool makes)
{
    memset(world, 0, sizeof *world);
    const struct table_wait wait = {makes ? give_up : NULL, note_end, world};
    const struct settings settings = settings_default();
    assert_true(table_cache_create(&world->tables, &settings, NULL));
    world->request.options.contact_model = PERCUSS_CONTACT_TABLE;
    table_maker_init(&world->maker, &wait, 3600.0);
    begin(world);
}

static void close_world(struct world *world)
{
    table_cache_release(&world->tables);
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
    assert_ptr_equal(source, table_store_source(world.tables.loaded));
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
    assert_int_equal(world.looks, 1);
    close_world(&world);
}

/* As whoever waits says. */
static void the_computation_ends_when_nobody_waits(void **state)
{
    (void)state;
    struct world world;
    open_world(&world, true);
    assert_null(find(&world));
    assert_int_equal(world.maker.status, PERCUSS_BUSY);
    assert_string_equal(world.maker.fault.text, "nobody waits");
    assert_int_equal(world.looks, 1);
    assert_true(world.has_ended);
    close_world(&world);
}

/* Where nobody may wait so long, the request is for others. */
static void who_makes_none_says_so(void **state)
{
    (void)state;
    struct world world;
    open_world(&world, false);
    assert_null(find(&world));
    assert_int_equal(world.maker.status, PERCUSS_BUSY);
    assert_string_equal(world.maker.fault.text, "the contact table is not computed yet: ask again");
    assert_false(world.has_ended);
    close_world(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_does_not_insist_gets_what_is_there),
        cmocka_unit_test(who_only_finds_computes_nothing),
        cmocka_unit_test(the_computation_ends_when_nobody_waits),
        cmocka_unit_test(who_makes_none_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
