/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests respond/table_cache.c: which requests need a table that is not there. */
#include <string.h>

#include "check.h"
#include "respond/table_cache.h"

static struct body bodies[] = {
    {.id = "steel", .material = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0}},
    {.id = "soft", .material = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0}},
};

/* Whether a contact of bodies a and b lacks a table for that model. */
static bool lacks(unsigned model, uint32_t a, uint32_t b)
{
    static const struct body_set set = {.bodies = bodies, .count = COUNT(bodies)};
    percuss_v1_BodyMotion motions[3] = {{.id = "steel"}, {.id = "soft"}, {.id = "unknown"}};
    percuss_v1_Contact contact = {.a = a, .b = b};
    percuss_v1_Request request = {.options.contact_model = model};
    request.bodies._buffer = motions;
    request.bodies._length = COUNT(motions);
    request.contacts._buffer = &contact;
    request.contacts._length = 1;
    struct table_cache cache;
    const struct settings settings = settings_default();
    assert_true(table_cache_create(&cache, &settings, NULL));
    bool result = table_cache_lacks(&cache, &set, &request);
    table_cache_release(&cache);
    return result;
}

static void lacks_what_yields_and_insists(void **state)
{
    (void)state;
    assert_true(lacks(PERCUSS_CONTACT_TABLE, 0, 1));
    assert_true(lacks(PERCUSS_CONTACT_TABLE, 1, 0));
    assert_false(lacks(PERCUSS_CONTACT_AUTO, 0, 1));
    assert_false(lacks(PERCUSS_CONTACT_TABLE, 0, 0)); /* stays elastic */
    /* what is wrong is refused by whoever answers */
    assert_false(lacks(PERCUSS_CONTACT_TABLE, 0, 2));
    assert_false(lacks(PERCUSS_CONTACT_TABLE, 0, 9));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lacks_what_yields_and_insists)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
