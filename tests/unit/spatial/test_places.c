/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors tests/reference/spatial/places.c: points on both sides of a wall of its grid are one, and
 * ten thousand others are not. */
#include "check.h"
#include "spatial/places.h"

static void finds_points_again(void **state)
{
    (void)state;
    struct places places = {.same = 1e-9};
    assert_true(places_find(&places, (const double[3]){0.0, 0.0, 0.0}) == SIZE_MAX);
    /* a lattice whose points lie on the walls, which are a thousand times as wide apart */
    for (size_t i = 0; i < 10000; i++) {
        double point[3] = {1e-6 * (double)(i % 100), 1e-6 * (double)(i / 100), -1e-6};
        assert_true(places_add(&places, point) == i);
    }
    for (size_t i = 0; i < 10000; i++)
        for (int s = -1; s <= 1; s++) {
            double off = 0.4e-9 * s;
            double point[3] = {1e-6 * (double)(i % 100) + off, 1e-6 * (double)(i / 100) - off,
                               -1e-6 + off};
            assert_true(places_find(&places, point) == i);
            assert_true(places_add(&places, point) == i);
        }
    assert_true(places.count == 10000);
    assert_true(places_find(&places, (const double[3]){1.1e-8, 0.0, -1e-6}) == SIZE_MAX);
    places_free(&places);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(finds_points_again)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
