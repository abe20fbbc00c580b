/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Edges of bodies from meshes: how near a contact may come to one. */
#include "physics/mesh_twins.h"

static void edges_are_refused_by_distance(void **state)
{
    (void)state;
    static struct solve_result result;
    struct twins twins = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0), 20, 0.0);
    struct solve_request request = strike(sphere_spot("ball", 0.015), end_spot("mesh", 1.0), 0.3);
    /* both as they are, the rod moved sideways under the ball */
    double axis[3], rotation[9];
    rotation_matrix(request.bodies[1].orientation, rotation);
    rotate3(rotation, (double[3]){0.0, 0.0102, 0.0}, axis);
    add_scaled3(1.0, axis, request.bodies[1].position);
    solve(twins.lab->workspace, &twins.lab->means, &request, &result);
    assert_int_equal(result.status, PERCUSS_UNSUPPORTED_GEOMETRY);
    twins_free(&twins);
}

/* By the element that is hit: those of the ends are 5 mm long, those of the side 25 mm. */
static void an_edge_is_near_by_the_element_there(void **state)
{
    (void)state;
    static struct solve_result result;
    const double places[] = {0.0, 0.004, 0.0088};
    struct twins twins = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0), 20, 0.0);
    assert_true(twins.surface->element_size > 0.02);
    for (size_t i = 0; i < COUNT(places); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), end_spot("mesh", 1.0), 0.3);
        double aside[3], rotation[9];
        bool near_edge = false;
        rotation_matrix(request.bodies[1].orientation, rotation);
        rotate3(rotation, (double[3]){0.0, places[i], 0.0}, aside);
        add_scaled3(1.0, aside, request.bodies[1].position);
        lab_solve(twins.lab, &request, &result);
        for (size_t w = 0; w < result.warning_count; w++)
            near_edge = near_edge || strstr(result.warnings[w], "whose elements there are 0.00");
        assert_int_equal(near_edge, i == 2);
    }
    twins_free(&twins);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_are_refused_by_distance),
        cmocka_unit_test(an_edge_is_near_by_the_element_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
