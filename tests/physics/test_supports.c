/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What supports leave of a body's rigid motion: W, the velocities after, and who cannot be hit. */
#include "physics/support.h"

static const double LENGTH = 0.6, RADIUS = 0.012, X = 0.13;

/* A point force across a beam at x: 1/m + x^2/I about the centre of mass, or (x - pin)^2/I_pin. */
static double beam_w(double mass, double inertia, enum support left, enum support right)
{
    if (left == SUPPORT_FREE && right == SUPPORT_FREE)
        return 1.0 / mass + X * X / inertia;
    bool one_pin = (left == SUPPORT_PINNED && right == SUPPORT_FREE) ||
                   (left == SUPPORT_FREE && right == SUPPORT_PINNED);
    if (!one_pin)
        return 0.0;
    double pin = left == SUPPORT_PINNED ? -0.5 * LENGTH : 0.5 * LENGTH;
    return (X - pin) * (X - pin) / (inertia + mass * 0.25 * LENGTH * LENGTH);
}

static void supports_rule_w(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    const struct body *ball = lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    double mass = 2700.0 * M_PI * RADIUS * RADIUS * LENGTH;
    for (int i = 0; i < 18; i++) {
        enum support left = (enum support)(i % 3);
        enum support right = (enum support)(i / 3 % 3);
        struct body beam =
            make_supported(make_bar(&beam_kind, ALUMINIUM, RADIUS, LENGTH), left, right);
        beam.theory = i < 9 ? THEORY_TIMOSHENKO : THEORY_EULER_BERNOULLI;
        lab_add(lab, "beam", beam);
        /* notes: Euler-Bernoulli M L^2/12, Timoshenko M (L^2/12 + r^2/4) */
        double inertia = mass * (LENGTH * LENGTH / 12.0 + (i < 9 ? RADIUS * RADIUS / 4.0 : 0.0));
        double w = beam_w(mass, inertia, left, right);
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", X, RADIUS, 0.3), 0.2);
        request.options.tolerance = 1e-2;
        lab_solve(lab, &request, &result);
        measured_relative("W", result.contacts[0].inverse_effective_mass, 1.0 / ball->mass + w,
                          1e-13);
        /* the struck point moves by w P along -n, a beam that cannot move stays */
        double arm[3];
        double turning[3];
        sub3(request.contacts[0].point, request.bodies[1].position, arm);
        cross3(result.bodies[1].angular_velocity, arm, turning);
        measured("velocity of the struck point", result.bodies[1].velocity[2] + turning[2],
                 -w * result.contacts[0].impulse, 1e-13);
        double speed = norm3(result.bodies[1].velocity);
        assert_true(w > 0.0 ? speed > 0.0 : speed == 0.0);
    }
    lab_free(lab);
}

/* A beam pinned at one end turns about the pin: the pin's own velocity stays zero. */
static void the_pin_stays(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam",
            make_supported(make_bar(&beam_kind, ALUMINIUM, RADIUS, LENGTH), SUPPORT_FREE,
                           SUPPORT_PINNED));
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", X, RADIUS, 0.0), 0.2);
    uint64_t seed = 9;
    double q[4];
    random_rotation(&seed, q);
    move_scene(&request, q, (double[]){1.0, 2.0, 3.0}, (double[]){0.0, 0.0, 0.0});
    lab_solve(lab, &request, &result);
    double rotation[9];
    double arm[3];
    double velocity[3];
    rotation_matrix(request.bodies[1].orientation, rotation);
    rotate3(rotation, (double[]){0.5 * LENGTH, 0.0, 0.0}, arm);
    cross3(result.bodies[1].angular_velocity, arm, velocity);
    add_scaled3(1.0, result.bodies[1].velocity, velocity);
    measured("the pin's velocity", norm3(velocity), 0.0, 1e-15);
    assert_true(norm3(result.bodies[1].angular_velocity) > 0.01);
    lab_free(lab);
}

/* A rod held at the far end keeps only the striker's mass in W, and its waves come back inverted:
 * against d'Alembert's first return nothing is different before 2 L/c. */
static void a_fixed_rod_starts_like_a_free_one(void **state)
{
    (void)state;
    static struct solve_result result;
    double impulse[2];
    struct lab *lab = lab_create();
    const struct body *ball = lab_add(lab, "ball", make_sphere(STEEL, 0.006));
    for (int fixed = 0; fixed < 2; fixed++) {
        lab_add(lab, "rod",
                make_supported(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0),
                               fixed ? SUPPORT_CLAMPED : SUPPORT_FREE, SUPPORT_FREE));
        struct solve_request request =
            strike(sphere_spot("ball", 0.006), end_spot("rod", 1.0), 0.5);
        request.options.tolerance = 1e-8;
        lab_solve(lab, &request, &result);
        const struct sub_impact *sub = result.contacts[0].sub_impacts;
        impulse[fixed] = sub->impulse;
        /* over before the wave is back */
        assert_true(sub->end < 2.0 / sqrt(70e9 / 2700.0));
        if (fixed)
            measured_relative("W", result.contacts[0].inverse_effective_mass, 1.0 / ball->mass,
                              1e-14);
    }
    /* tolerance 1e-8 of each */
    measured_relative("first impulse", impulse[1], impulse[0], 1e-7);
    lab_free(lab);
}

static void who_cannot_move_cannot_meet(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    struct body tipped =
        make_supported(make_bar(&rod_kind, ALUMINIUM, 0.010, 0.4), SUPPORT_CLAMPED, SUPPORT_FREE);
    tipped.tip_radius = 0.02;
    lab_add(lab, "tipped", tipped);
    lab_add(lab, "wall", make_body(&half_space_kind, STEEL));
    lab_add(lab, "pinned",
            make_supported(make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0), SUPPORT_PINNED,
                           SUPPORT_PINNED));
    struct solve_request requests[] = {
        strike(end_spot("tipped", 0.4), wall_spot("wall"), 0.3),
        strike(end_spot("tipped", 0.4), side_spot("pinned", 0.1, 0.010, 0.0), 0.3),
    };
    for (size_t i = 0; i < COUNT(requests); i++) {
        assert_int_equal(solve(lab->workspace, &lab->means, &requests[i], &result),
                         PERCUSS_BAD_REQUEST);
        assert_non_null(strstr(result.fault.text, "contacts[0]"));
        assert_non_null(strstr(result.fault.text, "tipped"));
        /* the client's W may know of a carriage underneath */
        double w = 3.0;
        requests[i].delassus = &w;
        lab_solve(lab, &requests[i], &result);
        assert_true(result.contacts[0].impulse > 0.1 * 0.3 / 3.0);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(supports_rule_w),
        cmocka_unit_test(the_pin_stays),
        cmocka_unit_test(a_fixed_rod_starts_like_a_free_one),
        cmocka_unit_test(who_cannot_move_cannot_meet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
