/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where an impact begins and ends: the bound of the vibration, acceleration, horizon, gaps. */
#include "physics/support.h"

static struct lab *paper(void)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    return lab;
}

static struct solve_request on_beam(double speed)
{
    return strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), speed);
}

static struct solve_request ball_on_ball(double speed)
{
    return strike(sphere_spot("ball", 0.015), sphere_spot("ball", 0.015), speed);
}

static void the_bound_ends_the_paper_s_beam(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper();
    for (double speed = 0.09; speed < 0.4105; speed += 0.004) {
        struct solve_request request = on_beam(speed);
        lab_solve(lab, &request, &result);
        assert_int_equal(result.end_reason, PERCUSS_END_SEPARATED);
        assert_true(result.complete);
        /* the notes: within 9 ms at every speed */
        assert_true(result.window < 9e-3);
        assert_true(result.window >= result.contacts[0].end_time);
        /* the paper: one to four impacts, grazing ones aside */
        size_t counted = 0;
        for (size_t i = 0; i < result.contacts[0].sub_impact_count; i++)
            counted += !result.contacts[0].sub_impacts[i].negligible;
        assert_in_range(counted, 1, 4);
    }
    lab_free(lab);
}

/* Nothing that the bound ends may touch again: the same impact with a long horizon by CVODE has no
 * further sub-impact, and with a pressing acceleration the end is the slow scale's. */
static void pressing_bodies_are_handed_back(void **state)
{
    (void)state;
    static struct solve_result free_flight, pressed;
    struct lab *lab = paper();
    struct solve_request request = on_beam(0.2);
    lab_solve(lab, &request, &free_flight);
    request.contacts[0].gap_acceleration = -1e-6;
    lab_solve(lab, &request, &pressed);
    assert_int_equal(pressed.end_reason, PERCUSS_END_HANDED_BACK);
    assert_true(pressed.complete);
    /* 1e-6 m/s^2 over 6 ms is nothing */
    measured("e", pressed.contacts[0].restitution, free_flight.contacts[0].restitution, 1e-5);
    request.contacts[0].gap_acceleration = 1e-6;
    lab_solve(lab, &request, &pressed);
    assert_int_equal(pressed.end_reason, PERCUSS_END_SEPARATED);
    lab_free(lab);
}

static void gravity_counts_during_the_impact(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper();
    struct solve_request request = ball_on_ball(0.1);
    request.contacts[0].gap_acceleration = -9.81;
    request.options.tolerance = 1e-9;
    lab_solve(lab, &request, &result);
    const struct sub_impact *sub = result.contacts[0].sub_impacts;
    double w = result.contacts[0].inverse_effective_mass;
    /* a conservative force field and an elastic contact: the gap's energy is kept, so it parts as
     * fast as it came (read at the end of the step in which it opens, 2e-10 s late), and the
     * impulse has the weight during the contact on top */
    measured("rate after", sub->gap_rate_after, 0.1, 5e-9);
    measured("impulse", sub->impulse * w, 0.2 + 9.81 * (sub->end - sub->start), 1e-9);
    assert_int_equal(result.end_reason, PERCUSS_END_HANDED_BACK);
    lab_free(lab);
}

static void the_horizon_cuts(void **state)
{
    (void)state;
    static struct solve_result whole, cut;
    struct lab *lab = paper();
    struct solve_request request = on_beam(0.2);
    lab_solve(lab, &request, &whole);
    double first = whole.contacts[0].sub_impacts[0].impulse;
    request.options.horizon = 3e-3; /* in the flight: the second starts at 5.2 ms */
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &cut), PERCUSS_TRUNCATED);
    assert_int_equal(cut.end_reason, PERCUSS_END_HORIZON);
    assert_false(cut.complete);
    measured("window", cut.window, 3e-3, 1e-12);
    /* default tolerance of 1e-3 on e, of which each run uses a part */
    measured_relative("impulse so far", cut.contacts[0].impulse, first, 1e-3);
    request.options.horizon = 1e-4; /* in the first contact of 188 us */
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &cut), PERCUSS_TRUNCATED);
    assert_int_equal(cut.end_reason, PERCUSS_END_IN_CONTACT);
    assert_false(cut.complete);
    assert_true(cut.contacts[0].impulse > 0.3 * first && cut.contacts[0].impulse < 0.9 * first);
    /* the last step ends a shortest step before the horizon at most */
    measured("window", cut.window, 1e-4, 2e-6);
    assert_true(strlen(cut.fault.text) > 0);
    lab_free(lab);
}

/* A gap delays, an overlap advances, by gap over speed; nothing else changes. */
static void gaps_shift_the_impact(void **state)
{
    (void)state;
    static struct solve_result touching, shifted;
    static const double gaps[] = {-1e-3, -5e-4, -1e-7, 1e-9, 1e-4, 1e-3};
    struct lab *lab = paper();
    for (int method = PERCUSS_METHOD_MODAL; method <= PERCUSS_METHOD_CVODE; method++) {
        struct solve_request request = ball_on_ball(0.1);
        request.options.tolerance = 1e-8;
        request.options.method = (enum percuss_method)method;
        lab_solve(lab, &request, &touching);
        double start = touching.contacts[0].sub_impacts[0].start;
        double end = touching.contacts[0].sub_impacts[0].end;
        measured("time shift", touching.time_shift, 0.0, 0.0);
        for (size_t i = 0; i < COUNT(gaps); i++) {
            request.contacts[0].gap = gaps[i];
            lab_solve(lab, &request, &shifted);
            /* steps start elsewhere: tolerance 1e-8 */
            measured("e", shifted.contacts[0].restitution, touching.contacts[0].restitution, 2e-8);
            measured("time shift", shifted.time_shift, gaps[i] / 0.1, 1e-14);
            measured("start", shifted.contacts[0].sub_impacts[0].start, gaps[i] / 0.1 + start,
                     1e-14);
            measured("end", shifted.contacts[0].sub_impacts[0].end, gaps[i] / 0.1 + end, 1e-10);
        }
    }
    lab_free(lab);
}

/* Overlap and acceleration: the touch is the root of -gap + rate t + a t^2/2 behind or ahead. */
static void acceleration_shifts_the_touch(void **state)
{
    (void)state;
    static struct solve_result result;
    static const struct {
        double gap, acceleration, expected;
    } cases[] = {
        {2e-4, 9.81, 2.24783883e-3},    /* braked */
        {2e-4, -9.81, 1.83486239e-3},   /* hastened */
        {-2e-4, -9.81, -2.24783883e-3}, /* was slower */
        {-2e-4, 9.81, -1.83486239e-3},
    };
    struct lab *lab = paper();
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct solve_request request = ball_on_ball(0.1);
        double a = cases[i].acceleration;
        double t = cases[i].expected;
        request.contacts[0].gap = cases[i].gap;
        request.contacts[0].gap_acceleration = a;
        lab_solve(lab, &request, &result);
        measured("touch", result.time_shift, t, 1e-10);
        measured("rate at the touch", result.contacts[0].sub_impacts[0].gap_rate_before,
                 -0.1 + a * t, 1e-9);
    }
    lab_free(lab);
}

/* Never in touch: braked before it, or the horizon comes first. */
static void bodies_may_miss(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper();
    struct solve_request request = ball_on_ball(0.1);
    request.contacts[0].gap = 1e-3;
    request.contacts[0].gap_acceleration = 9.81;
    lab_solve(lab, &request, &result);
    assert_int_equal(result.contacts[0].sub_impact_count, 0);
    assert_int_equal(result.end_reason, PERCUSS_END_SEPARATED);
    measured("no impulse", result.contacts[0].impulse, 0.0, 0.0);
    assert_true(isfinite(result.energy.closure));
    request.contacts[0].gap_acceleration = 0.0;
    request.options.horizon = 5e-3;
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &result), PERCUSS_TRUNCATED);
    assert_int_equal(result.end_reason, PERCUSS_END_HORIZON);
    assert_int_equal(result.contacts[0].sub_impact_count, 0);
    lab_free(lab);
}

/* An overlap that no flight explains is refused, not answered; an old one is found however old. */
static void overlaps_create_no_energy(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper();
    struct solve_request request = ball_on_ball(0.01);
    request.contacts[0].gap = -4e-4; /* touched 40 ms ago, beyond the default horizon */
    lab_solve(lab, &request, &result);
    measured("e", result.contacts[0].restitution, 1.0, 1e-3);
    measured("time shift", result.time_shift, -0.04, 1e-12);
    request = on_beam(0.01);
    request.contacts[0].gap = -4e-4;
    lab_solve(lab, &request, &result);
    assert_true(fabs(result.energy.closure) <= 1e-2 * result.energy.available);
    request = ball_on_ball(0.1);
    request.contacts[0].gap = -2e-3;
    request.contacts[0].gap_acceleration = -9.81; /* a^2/2a: 0.5 mm at most */
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &result), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(result.fault.text, "contacts[0].gap"));
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bound_ends_the_paper_s_beam),
        cmocka_unit_test(pressing_bodies_are_handed_back),
        cmocka_unit_test(gravity_counts_during_the_impact),
        cmocka_unit_test(the_horizon_cuts),
        cmocka_unit_test(gaps_shift_the_impact),
        cmocka_unit_test(acceleration_shifts_the_touch),
        cmocka_unit_test(bodies_may_miss),
        cmocka_unit_test(overlaps_create_no_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
