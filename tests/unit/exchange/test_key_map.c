/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/key_map.c: nodes are found while it grows far beyond what was expected. */
#include "sample.h"

#include "exchange/key_map.h"

enum { NODES = 5000 };

/* Keys as clients choose them: small numbers, alike in their second half. */
static struct digest key_of(size_t i)
{
    return (struct digest){i, i % 3};
}

static void finds_what_it_has_while_it_grows(void **state)
{
    (void)state;
    static struct key_node nodes[NODES];
    struct key_map map;
    assert_true(key_map_create(&map, 4));
    for (size_t i = 0; i < NODES; i++) {
        nodes[i].key = key_of(i);
        assert_null(key_map_find(&map, key_of(i)));
        key_map_insert(&map, &nodes[i]);
        assert_ptr_equal(key_map_find(&map, key_of(i / 2)), &nodes[i / 2]);
    }
    assert_int_equal(map.count, NODES);
    assert_true(map.mask + 1 >= NODES);
    for (size_t i = 0; i < NODES; i += 2)
        key_map_remove(&map, &nodes[i]);
    assert_int_equal(map.count, NODES / 2);
    for (size_t i = 0; i < NODES; i++)
        assert_ptr_equal(key_map_find(&map, key_of(i)), i % 2 ? &nodes[i] : NULL);
    key_map_release(&map);
}

static void tells_keys_apart_by_both_halves(void **state)
{
    (void)state;
    struct key_node one = {.key = {7, 1}}, two = {.key = {7, 2}};
    struct key_map map;
    assert_true(key_map_create(&map, 1));
    key_map_insert(&map, &one);
    key_map_insert(&map, &two);
    assert_ptr_equal(key_map_find(&map, (struct digest){7, 1}), &one);
    assert_ptr_equal(key_map_find(&map, (struct digest){7, 2}), &two);
    assert_null(key_map_find(&map, (struct digest){1, 7}));
    key_map_release(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_what_it_has_while_it_grows),
        cmocka_unit_test(tells_keys_apart_by_both_halves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
