/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Two flexible bodies in one contact, and what must not matter: which of them is called a, and how
 * a round beam is turned about its axis. */
#include "physics/support.h"

static struct lab *lab_of_bars(void)
{
    struct lab *lab = lab_create();
    struct body tipped = make_bar(SHAPE_ROD, ALUMINIUM, 0.010, 0.4);
    tipped.tip_radius = 0.015;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "tipped", tipped);
    lab_add(lab, "flat", make_bar(SHAPE_ROD, STEEL, 0.010, 0.7));
    lab_add(lab, "beam", make_bar(SHAPE_BEAM, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "steel-beam", make_bar(SHAPE_BEAM, STEEL, 0.012, 0.5));
    return lab;
}

static double restitution(struct lab *lab, const struct solve_request *request,
                          struct solve_result *result)
{
    lab_solve(lab, request, result);
    return result->contacts[0].restitution;
}

/* a strikes b, and b strikes a: one e, one impulse, opposite directions. */
static void the_roles_can_be_swapped(void **state)
{
    (void)state;
    static struct solve_result first, second;
    struct lab *lab = lab_of_bars();
    const struct spot tip = end_spot("tipped", 0.4);
    const struct spot cases[][2] = {
        {sphere_spot("ball", 0.015), side_spot("beam", 0.11, 0.010, 0.0)},
        {tip, end_spot("flat", 0.7)},
        {tip, side_spot("beam", -0.2, 0.010, 0.0)},
        {side_spot("steel-beam", 0.05, 0.012, 0.0), side_spot("beam", 0.0, 0.010, 0.0)},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct spot a = cases[i][0];
        struct spot b = cases[i][1];
        a.roll = 0.5 * M_PI; /* beams cross */
        struct solve_request request = strike(a, b, 0.3);
        request.options.tolerance = 1e-7;
        double e = restitution(lab, &request, &first);
        struct solve_request swapped = request;
        swapped.bodies[0] = request.bodies[1];
        swapped.bodies[1] = request.bodies[0];
        scale3(-1.0, request.contacts[0].normal, swapped.contacts[0].normal);
        /* sums run in another order: rounding, amplified by a sequence of sub-impacts */
        measured("e, swapped", restitution(lab, &swapped, &second), e, 1e-9);
        for (int k = 0; k < 3; k++) {
            double p = second.contacts[0].impulse_vector[k];
            measured("impulse vector", -p, first.contacts[0].impulse_vector[k],
                     1e-9 * first.contacts[0].impulse);
            for (int body = 0; body < 2; body++)
                measured("velocity", second.bodies[1 - body].velocity[k],
                         first.bodies[body].velocity[k], 1e-9);
        }
        assert_int_equal(first.bodies[0].modes, second.bodies[1].modes);
        assert_int_equal(first.bodies[1].modes, second.bodies[0].modes);
    }
    lab_free(lab);
}

/* Modal against CVODE with fixed numbers of modes in both bodies: one model, two integrations. */
static void both_bodies_vibrate(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_bars();
    for (size_t i = 0; i < lab->set.count; i++) {
        struct body body = lab->bodies[i];
        body.modes = body_is_flexible(&body) ? 10 : 0;
        lab_add(lab, lab->bodies[i].id, body);
    }
    struct spot across = side_spot("steel-beam", 0.05, 0.012, 0.0);
    across.roll = 0.5 * M_PI;
    const struct spot cases[][2] = {
        {end_spot("tipped", 0.4), end_spot("flat", 0.7)},
        {end_spot("tipped", 0.4), side_spot("beam", -0.2, 0.010, 0.0)},
        {across, side_spot("beam", 0.0, 0.010, 0.0)},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct solve_request request = strike(cases[i][0], cases[i][1], 0.3);
        request.options.tolerance = 1e-7;
        double modal = restitution(lab, &request, &result);
        assert_true(result.bodies[0].modes > 0 && result.bodies[1].modes > 0);
        assert_true(result.bodies[0].vibration > 0.0 && result.bodies[1].vibration > 0.0);
        request.options.method = PERCUSS_METHOD_CVODE;
        /* tolerance 1e-7 each, amplified by a sequence */
        measured("e, modal and cvode", modal, restitution(lab, &request, &result), 1e-5);
    }
    lab_free(lab);
}

/* Equal round-tipped rods: by symmetry each feels half the approach, as if it met a rigid wall at
 * half the speed with a contact of the double stiffness per half indentation. */
static void equal_rods_are_a_rod_on_a_mirror(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    struct body rod = make_bar(SHAPE_ROD, ALUMINIUM, 0.010, 0.4);
    rod.tip_radius = 0.015;
    lab_add(lab, "rod", rod);
    lab_add(lab, "wall",
            make_body(SHAPE_HALF_SPACE,
                      (struct material){"rigid", 1e13, -1.0 + 1e-12, 1000.0, INFINITY, 0.0}));
    struct solve_request pair = strike(end_spot("rod", 0.4), end_spot("rod", 0.4), 0.6);
    struct solve_request mirror = strike(end_spot("rod", 0.4), wall_spot("wall"), 0.3);
    pair.options.tolerance = mirror.options.tolerance = 1e-8;
    /* tip on tip: k = 4/3 (E'/2) sqrt(R/2); d = 2 x gives F = 4/3 E' sqrt(R) x^1.5: exactly the tip
     * on a rigid plane */
    double e = restitution(lab, &pair, &result);
    measured("e, pair and mirror", e, restitution(lab, &mirror, &result), 2e-8);
    lab_free(lab);
}

/* A round beam rolled about its axis: both planes of bending share the blow. */
static void a_round_beam_may_be_rolled(void **state)
{
    (void)state;
    static struct solve_result result;
    static const double sites[] = {0.0, 0.17, 0.4};
    struct lab *lab = lab_of_bars();
    for (size_t i = 0; i < COUNT(sites); i++) {
        struct spot ball = sphere_spot("ball", 0.015);
        struct solve_request plain = strike(ball, side_spot("beam", sites[i], 0.010, 0.0), 0.25);
        plain.options.tolerance = 1e-8;
        double e = restitution(lab, &plain, &result);
        double first = result.contacts[0].sub_impacts[0].impulse;
        unsigned modes = result.bodies[1].modes;
        for (double about = 0.3; about < 3.0; about += 0.9) {
            struct solve_request rolled =
                strike(ball, side_spot("beam", sites[i], 0.010, about), 0.25);
            rolled.options.tolerance = 1e-8;
            /* twice the oscillators for the same motion; tolerance 1e-8 on either side, and a
             * sequence amplifies */
            measured("e, rolled", restitution(lab, &rolled, &result), e, 1e-6);
            measured_relative("first impulse", result.contacts[0].sub_impacts[0].impulse, first,
                              1e-9);
            assert_true(result.bodies[1].modes > modes);
        }
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_roles_can_be_swapped),
        cmocka_unit_test(both_bodies_vibrate),
        cmocka_unit_test(equal_rods_are_a_rod_on_a_mirror),
        cmocka_unit_test(a_round_beam_may_be_rolled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
