/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/solve/placed.c: what is found again, and what makes it another place. */
#include "physics/support.h"
#include "solve/placed.h"

/* A ball on a beam. */
struct blow {
    struct body bodies[2];
    struct pose poses[2];
    double point[3], normal[3];
};

static struct blow make(double x)
{
    struct blow spot;
    memset(&spot, 0, sizeof spot);
    spot.bodies[0] = make_sphere(STEEL, 0.015);
    spot.bodies[1] = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    for (int which = 0; which < 2; which++)
        for (int i = 0; i < 3; i++)
            spot.poses[which].rotation[4 * i] = 1.0;
    spot.poses[0].position[0] = spot.point[0] = x;
    spot.normal[2] = 1.0;
    return spot;
}

static struct placed_key key_of(const struct blow *spot)
{
    return (struct placed_key){{&spot->bodies[0], &spot->bodies[1]},
                               {&spot->poses[0], &spot->poses[1]},
                               spot->point,
                               spot->normal};
}

/* Whether it is kept: then as numbers that follow from x; otherwise it is to be kept as such, if it
 * may be. */
static bool ask(struct placed_store *store, const struct blow *spot, double x)
{
    struct placed_key key = key_of(spot);
    struct contact_side sides[2];
    struct hertz_contact hertz;
    struct placed *room;
    memset(sides, 0, sizeof sides);
    bool found = placed_find(store, &key, sides, &hertz, &room);
    if (found) {
        assert_true(sides[0].site.point[0] == x && sides[1].direction[2] == 2.0 * x);
        assert_true(hertz.stiffness == 3.0 * x);
        return true;
    }
    sides[0].site.point[0] = x;
    sides[1].direction[2] = 2.0 * x;
    hertz = (struct hertz_contact){.stiffness = 3.0 * x};
    if (room)
        placed_keep(room, &key, sides, &hertz);
    return false;
}

/* The first time it is marked, the second time kept. */
static void it_is_found_from_the_third_time_on(void **state)
{
    (void)state;
    struct placed_store *store = placed_store_create();
    assert_non_null(store);
    struct blow spot = make(0.1);
    assert_false(ask(store, &spot, 0.1));
    assert_false(ask(store, &spot, 0.1));
    for (int i = 0; i < 3; i++)
        assert_true(ask(store, &spot, 0.1));
    /* what was refused in between is not kept */
    struct blow other = make(0.2);
    struct placed_key key = key_of(&other);
    struct contact_side sides[2];
    struct hertz_contact hertz;
    struct placed *room;
    for (int i = 0; i < 4; i++)
        assert_false(placed_find(store, &key, sides, &hertz, &room));
    placed_store_free(store);
}

/* Each number of it, by its last bit, also those that the mark does not look at. */
static void any_bit_makes_another_place(void **state)
{
    (void)state;
    for (int change = 0; change < 9; change++) {
        struct placed_store *store = placed_store_create();
        assert_non_null(store);
        struct blow spot = make(0.1);
        for (int i = 0; i < 2; i++)
            ask(store, &spot, 0.1);
        assert_true(ask(store, &spot, 0.1));
        double *const numbers[] = {&spot.point[1],
                                   &spot.normal[0],
                                   &spot.poses[0].position[2],
                                   &spot.poses[1].rotation[3],
                                   &spot.poses[0].rotation[8],
                                   &spot.bodies[0].radius,
                                   &spot.bodies[1].length,
                                   &spot.bodies[1].material.young,
                                   &spot.bodies[0].material.yield};
        *numbers[change] = nextafter(*numbers[change], -1.0);
        assert_false(ask(store, &spot, 0.3));
        ask(store, &spot, 0.3);
        assert_true(ask(store, &spot, 0.3));
        placed_store_free(store);
    }
}

/* More by turns than there is room for: none of them is taken for another. */
static void many_places_make_way_for_each_other(void **state)
{
    (void)state;
    struct placed_store *store = placed_store_create();
    assert_non_null(store);
    unsigned found = 0;
    for (int i = 0; i < 40 * PLACED_PLACES; i++) {
        double x = 0.01 * (i / 4 % 5 + (i % 3 ? 0 : i % (3 * PLACED_PLACES)));
        struct blow spot = make(x);
        found += ask(store, &spot, x);
    }
    assert_true(found > 0);
    placed_store_free(store);
}

/* Their sites lie in the catalogue, which may go. */
static void bodies_of_meshes_are_not_kept(void **state)
{
    (void)state;
    static const struct mesh_body mesh;
    struct placed_store *store = placed_store_create();
    assert_non_null(store);
    struct blow spot = make(0.1);
    spot.bodies[1].mesh = &mesh;
    for (int i = 0; i < 5; i++)
        assert_false(ask(store, &spot, 0.1));
    placed_store_free(store);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_found_from_the_third_time_on),
        cmocka_unit_test(any_bit_makes_another_place),
        cmocka_unit_test(many_places_make_way_for_each_other),
        cmocka_unit_test(bodies_of_meshes_are_not_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
