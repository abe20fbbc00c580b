/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api/lists.c: a catalogue from what a server announces of its bodies, one by one. */
#include "lists.h"

#include <stdio.h>
#include <string.h>

#include "check.h"

enum { BODIES = 3000, MATERIALS = 60 };

static void name(char text[PERCUSS_ID_SIZE], const char *what, unsigned number)
{
    snprintf(text, PERCUSS_ID_SIZE, "%s %04u", what, number);
}

/* A body of a material that has a pair with each material, all of them in the order of names. */
static void add(struct lists_bodies *made, unsigned number, const char *revision)
{
    percuss_v1_MaterialPair pairs[MATERIALS];
    const unsigned material = number % MATERIALS;
    percuss_v1_Body wire = {.mass = number, .pairs = {MATERIALS, MATERIALS, pairs, false}};
    name(wire.id, "body", number);
    snprintf(wire.catalogue_revision, sizeof wire.catalogue_revision, "%s", revision);
    for (unsigned i = 0; i < MATERIALS; i++) {
        unsigned first = material < i ? material : i, second = material < i ? i : material;
        pairs[i] = (percuss_v1_MaterialPair){.friction = MATERIALS * first + second};
        name(pairs[i].material_a, "material", first);
        name(pairs[i].material_b, "material", second);
    }
    lists_add_body(made, &wire);
}

/* Thousands of bodies, which announce a hundred pairs for each that there is. */
static void every_pair_stands_once(void **state)
{
    (void)state;
    struct percuss_body_list list;
    struct lists_bodies made = lists_begin_bodies(BODIES);
    for (unsigned i = 0; i < BODIES; i++)
        add(&made, (7 * i) % BODIES, "one");
    assert_true(made.pair_room <= 2 * MATERIALS * (MATERIALS + 1));
    assert_int_equal(lists_end_bodies(&made, &list), PERCUSS_RESULT_OK);
    assert_int_equal(list.count, BODIES);
    for (unsigned i = 0; i < BODIES; i++)
        assert_true(list.bodies[i].mass == i);
    assert_int_equal(list.pair_count, MATERIALS * (MATERIALS + 1) / 2);
    size_t at = 0;
    for (unsigned a = 0; a < MATERIALS; a++)
        for (unsigned b = a; b < MATERIALS; b++)
            assert_true(list.pairs[at++].friction == MATERIALS * a + b);
    percuss_body_list_free(&list);
}

static void two_catalogues_are_noticed(void **state)
{
    (void)state;
    struct lists_bodies made = lists_begin_bodies(4);
    assert_false(made.mixed);
    add(&made, 0, "one");
    add(&made, 1, "one");
    assert_true(!made.mixed && strcmp(made.list.catalogue_revision, "one") == 0);
    add(&made, 2, "two");
    add(&made, 3, "one");
    assert_true(made.mixed);
    percuss_body_list_free(&made.list);
}

static void nothing_is_a_list(void **state)
{
    (void)state;
    struct percuss_body_list list;
    struct lists_bodies made = lists_begin_bodies(0);
    assert_int_equal(lists_end_bodies(&made, &list), PERCUSS_RESULT_OK);
    assert_true(list.count == 0 && list.pair_count == 0 && !list.pairs);
    percuss_body_list_free(&list);
    made = lists_begin_bodies(1);
    made.failed = true;
    add(&made, 0, "one");
    assert_int_equal(lists_end_bodies(&made, &list), PERCUSS_RESULT_NO_MEMORY);
    assert_true(!list.bodies && list.count == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pair_stands_once),
        cmocka_unit_test(two_catalogues_are_noticed),
        cmocka_unit_test(nothing_is_a_list),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
