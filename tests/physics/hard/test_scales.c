/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stiffness, mass and speed over many decades: rigid spheres by the closed form of Hertz, flexible
 * bodies by CVODE and by what no passive system can exceed. */
#include "physics/hard/hard.h"
#include "unit/impact/toy_scene.h"

/* Hertz (Johnson, section 11.4): d = (5 m v^2/(4 k))^(2/5), duration 2.943275 d/v. */
static void check_hertz(const struct solve_result *result, double k, double mass, double speed)
{
    const struct sub_impact *sub = result->contacts[0].sub_impacts;
    double d = pow(1.25 * mass * speed * speed / k, 0.4);
    assert_separated(result);
    assert_true(result->tolerance_met);
    assert_int_equal(result->contacts[0].sub_impact_count, 1);
    /* closed form in the solver too: rounding */
    measured("e", result->contacts[0].restitution, 1.0, 1e-12);
    measured_relative("indentation", sub->max_indentation, d, 1e-12);
    measured_relative("force", sub->peak_force, k * pow(d, 1.5), 1e-12);
    /* the constant's digits */
    measured_relative("duration", sub->end - sub->start, 2.943275 * d / speed, 1e-6);
}

static void stiffness_from_1e3_to_1e14(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    for (int decade = 3; decade <= 14; decade++) {
        double radius = decade < 10 ? 0.01 : 250.0;
        double density = decade < 10 ? 2700.0 : 1.0;
        double k = pow(10.0, decade);
        struct material stuff = {"stuff", 0.75 * k / sqrt(radius), 0.0, density, INFINITY, 0.0};
        lab_add(lab, "ball", make_sphere(stuff, radius));
        lab_add(lab, "wall", rigid_wall());
        /* k = 4/3 E sqrt(R) = the decade */
        double mass = 4.0 / 3.0 * M_PI * radius * radius * radius * density;
        struct solve_request request = strike(sphere_spot("ball", radius), wall_spot("wall"), 1e-3);
        request.options.horizon = 10.0;
        lab_solve(lab, &request, &result);
        check_hertz(&result, k, mass, 1e-3);
    }
    lab_free(lab);
}

static struct impact_outcome run_toy(struct toy *toy, bool cvode, double accuracy, double horizon)
{
    struct impact_outcome outcome;
    struct impact_settings settings = {.accuracy = accuracy, .horizon = horizon, .max_work = 1e9};
    assert_true(impact_create(&outcome, &toy->scene, &toy->arena));
    assert_int_equal(
        (cvode ? impact_cvode : impact_modal)(&toy->scene, &settings, &toy->arena, &outcome),
        PERCUSS_OK);
    return outcome;
}

/* A mass on a body of eight modes; the law from far softer than the slowest to far stiffer than the
 * fastest of them. */
static void stiffness_against_vibration(void **state)
{
    (void)state;
    static const double phi[8] = {1.4, -1.4, 1.4, -1.4, 1.4, -1.4, 1.4, -1.4};
    for (int decade = 3; decade <= 14; decade++) {
        struct toy toy;
        double omega[8];
        for (int i = 0; i < 8; i++)
            omega[i] = 1e4 * (i + 1);
        toy_init(&toy, 1);
        toy.w[0] = 9.0;
        toy.gap_rate[0] = -0.1;
        toy.laws[0] = contact_law_hertz(pow(10.0, decade));
        toy_add(&toy, 1, 8, omega, 0.0, phi);
        struct impact_outcome modal = run_toy(&toy, false, 1e-13, 10.0);
        struct impact_outcome cvode = run_toy(&toy, true, 1e-9, 10.0);
        assert_int_equal(modal.end_reason, PERCUSS_END_SEPARATED);
        assert_int_equal(cvode.end_reason, PERCUSS_END_SEPARATED);
        /* the reference has accuracy 1e-9; a sequence of sub-impacts amplifies it */
        measured_relative("first", modal.tracks[0].list[0].impulse, cvode.tracks[0].list[0].impulse,
                          1e-7);
        measured_relative("impulse", modal.tracks[0].impulse, cvode.tracks[0].impulse, 1e-4);
        /* what a tolerance of 1e-8 promises; the search gets there by such an accuracy */
        measured("closure", modal.energy.closure / modal.energy.available, 0.0, 1e-9);
        assert_in_range(modal.tracks[0].count, 1, 40);
        toy_free(&toy);
    }
}

/* Two rigid spheres of any ratio of mass: momentum and energy decide the velocities. */
static void mass_ratios_of_spheres(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    for (int decade = -6; decade <= 6; decade++) {
        double ratio = pow(10.0, decade);
        double radius = 0.01 * cbrt(ratio);
        lab_add(lab, "a", make_sphere(STEEL, radius));
        lab_add(lab, "b", make_sphere(STEEL, 0.01));
        struct solve_request request =
            strike(sphere_spot("a", radius), (struct spot){"b", {0, 0, 0.01}, {0, 0, 1}, 0}, 0.2);
        lab_solve(lab, &request, &result);
        assert_separated(&result);
        measured("e", result.contacts[0].restitution, 1.0, 1e-12);
        double a = -0.2 * (ratio - 1.0) / (ratio + 1.0);
        double b = -0.2 * 2.0 * ratio / (ratio + 1.0);
        /* rounding, of the larger velocity */
        measured("a after", result.bodies[0].velocity[2], a, 1e-14);
        measured("b after", result.bodies[1].velocity[2], b, 1e-14);
    }
    lab_free(lab);
}

/* A ball on a beam from a millionth of its mass to a million times it: passive, and momentum. */
static void mass_ratios_on_a_beam(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    const struct body *beam = &lab->bodies[1];
    for (int decade = -6; decade <= 3; decade++) {
        double mass = beam->mass * pow(10.0, decade);
        double radius = cbrt(0.75 * mass / (M_PI * STEEL.density));
        lab_add(lab, "ball", make_sphere(STEEL, radius));
        struct solve_request request =
            strike(sphere_spot("ball", radius), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
        hard_solve(lab, &request, &result);
        double e = result.contacts[0].restitution;
        double momentum =
            mass * (result.bodies[0].velocity[2] + 0.2) + beam->mass * result.bodies[1].velocity[2];
        measured("momentum", momentum / result.contacts[0].impulse, 0.0, 1e-12);
        /* the default tolerance allows ten times itself */
        measured("closure", closure_share(&result, 0.0), 0.0, 1e-2);
        assert_true(e >= -1.0 && e <= 1.0 + 1e-9);
        assert_true(result.status == PERCUSS_OK || result.end_reason == PERCUSS_END_HORIZON ||
                    result.end_reason == PERCUSS_END_LIMIT);
        if (getenv("PERCUSS_MEASURE"))
            print_message("    1e%d: e %.6f sub-impacts %zu %s met %d\n", decade, e,
                          result.contacts[0].sub_impact_count, end_reason_name(result.end_reason),
                          result.tolerance_met);
    }
    lab_free(lab);
}

/* Spheres have no scale of speed; a rod takes more of a faster, shorter impact. The reply warns
 * where small strains end: at 1 % of the wave speed. */
static void speeds_from_1e_9_to_100(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    double previous = 1.0 + 1e-6; /* the tolerance */
    for (int step = -9; step <= 2; step++) {
        double speed = pow(10.0, step);
        struct solve_request request = on_wall(speed);
        request.options.horizon = 10.0;
        lab_solve(lab, &request, &result);
        measured("sphere", result.contacts[0].restitution, 1.0, 1e-12);
        request = on_rod(speed);
        request.options.tolerance = 1e-6;
        request.options.horizon = 10.0;
        lab_solve(lab, &request, &result);
        assert_separated(&result);
        assert_true(result.tolerance_met);
        double e = result.contacts[0].restitution;
        if (getenv("PERCUSS_MEASURE"))
            print_message("    %g m/s: e %.8f, %zu sub-impacts\n", speed, e,
                          result.contacts[0].sub_impact_count);
        assert_true(e > 0.0 && e < previous + 1e-6);
        previous = e;
        assert_int_equal(has_warning(&result, "wave speed"), speed > 60.0);
        assert_int_equal(has_warning(&result, "Hertz's law ends"), speed > 60.0);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stiffness_from_1e3_to_1e14), cmocka_unit_test(stiffness_against_vibration),
        cmocka_unit_test(mass_ratios_of_spheres),     cmocka_unit_test(mass_ratios_on_a_beam),
        cmocka_unit_test(speeds_from_1e_9_to_100),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
