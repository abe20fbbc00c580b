/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Modes in unusual places and numbers: a contact at their node, 5000 of them, equal frequencies,
 * any damping, contacts longer than the slowest of them. */
#include "model/bar.h"
#include "physics/hard/hard.h"
#include "unit/impact/toy_scene.h"

/* First node of the first bending mode of the paper's beam, by bisection of its shape. */
static double first_node(const struct body *beam)
{
    struct modal_family *modes = modal_family_create(beam, BAR_BENDING_Z, 1);
    assert_non_null(modes);
    double low = 0.0;
    double high = 0.4;
    double sign[2];
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        for (int which = 0; which < 2; which++) {
            struct site site = {.face = SITE_BEAM_SIDE,
                                .point = {which ? middle : 0.0, 0.0, beam->radius},
                                .outward = {0.0, 0.0, 1.0}};
            struct site_load load = site_load_make(beam, &site, (double[]){0.0, 0.0, -1.0}, false);
            sign[which] = modal_participation(beam, modes, 0, &load.family[BAR_BENDING_Z]);
        }
        if (sign[0] * sign[1] > 0.0)
            low = middle;
        else
            high = middle;
    }
    modal_family_free(modes);
    return 0.5 * (low + high);
}

/* With no other mode than the one whose node is hit nothing can vibrate: all comes back. Away from
 * the node by a little, the loss grows with the square of the distance. */
static void a_contact_at_the_node_of_the_only_mode(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    struct body beam = lab->bodies[1];
    beam.modes = 1;
    lab_add(lab, "beam", beam);
    double node = first_node(&beam);
    measured("node / L", node, 0.276, 1e-3); /* 0.2242 from the end (slender beams) */
    static const double offsets[] = {0.0, 1e-8, 1e-4, 1e-3, 1e-2};
    double last = 0.0;
    for (int step = 0; step < 5; step++) {
        double x = node + offsets[step];
        struct solve_request request = on_beam(x, 0.2);
        request.options.tolerance = 1e-8;
        lab_solve(lab, &request, &result);
        assert_separated(&result);
        /* one mode is not enough for a beam, wherever it is hit, and the reply says so */
        assert_false(result.tolerance_met);
        assert_true(result.restitution_modes > 1e-8);
        double share = result.bodies[1].vibration / result.energy.available;
        if (step > 2) /* the shape is straight there, bent a little at 10 mm */
            measured_relative("growth", share, 100.0 * last, 0.1);
        last = share;
        if (step > 1)
            continue;
        /* one mode leaves static flexibility only: elastic, to the tolerance */
        measured("e", result.contacts[0].restitution, 1.0, 1e-8);
        assert_true(share < 1e-12);
    }
    lab_free(lab);
}

/* At a node of one of many modes nothing special happens: the answer is continuous there. */
static void a_node_among_many_modes(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    double node = first_node(&lab->bodies[1]);
    double e[3];
    for (int i = 0; i < 3; i++) {
        struct solve_request request = on_beam(node + 1e-7 * (i - 1), 0.05);
        request.options.tolerance = 1e-8;
        lab_solve(lab, &request, &result);
        assert_separated(&result);
        e[i] = result.contacts[0].restitution;
    }
    /* curvature over 1e-7 m, tolerance 1e-8 */
    measured("middle", e[1], 0.5 * (e[0] + e[2]), 1e-7);
    lab_free(lab);
}

/* A fixed number of modes as large as is allowed: the rod's limit, within the bound of the cost. */
static void five_thousand_modes(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    struct body rod = make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0);
    struct solve_request request = on_rod(0.3);
    request.options.tolerance = 1e-6;
    lab_solve(lab, &request, &result);
    double few = result.contacts[0].restitution;
    rod.modes = 5000;
    lab_add(lab, "rod", rod);
    hard_solve(lab, &request, &result);
    assert_separated(&result);
    assert_int_equal(result.bodies[1].modes, 5000);
    /* both tolerances */
    measured("e", result.contacts[0].restitution, few, 2e-6);
    measured("closure", closure_share(&result, 0.0), 0.0, 1e-5);
    /* one more is refused by name */
    struct fault fault = {0};
    rod.modes = 5001;
    assert_int_equal(body_complete(&rod, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "modes"));
    lab_free(lab);
}

/* Two modes whose frequencies agree to 15 digits are one mode in two coordinates. */
static void frequencies_equal_to_15_digits(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct toy split;
        struct toy single;
        double apart = i == 0 ? 0.0 : i == 1 ? 1e-15 : 1e-14;
        double omega[2] = {3.0, 3.0 * (1.0 + apart)};
        double phi[2] = {0.6, 0.8};
        toy_init(&split, 1);
        toy_init(&single, 1);
        split.gap_rate[0] = single.gap_rate[0] = -1.0;
        toy_add(&split, 1, 2, omega, 0.1, phi);
        toy_add(&single, 1, 1, omega, 0.1, (double[]){1.0});
        struct impact_outcome a = toy_run(&split, 1e-11, 1000.0);
        struct impact_outcome b = toy_run(&single, 1e-11, 1000.0);
        assert_int_equal(a.tracks[0].count, b.tracks[0].count);
        assert_int_equal(a.end_reason, PERCUSS_END_SEPARATED);
        /* what 1e-14 in the frequency and rounding over the steps make */
        measured_relative("impulse", a.tracks[0].impulse, b.tracks[0].impulse, 1e-11);
        measured_relative("vibration", a.energy.vibration, b.energy.vibration, 1e-10);
        toy_free(&split);
        toy_free(&single);
    }
}

/* A round beam has the same frequencies in both planes: the side that is hit does not matter. */
static void equal_frequencies_in_two_planes(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    double first = 0.0;
    for (int i = 0; i < 5; i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", 0.1, 0.010, 0.4 * i), 0.1);
        request.options.tolerance = 1e-8;
        lab_solve(lab, &request, &result);
        assert_separated(&result);
        first = i ? first : result.contacts[0].restitution;
        /* the tolerance, twice */
        measured("e", result.contacts[0].restitution, first, 2e-8);
    }
    lab_free(lab);
}

/* Any damping against CVODE; the audit holds the dampers' share. */
static void damping_from_0_to_0_99(void **state)
{
    (void)state;
    static const double ratios[] = {0.0, 1e-6, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99};
    static struct solve_result result;
    for (size_t i = 0; i < COUNT(ratios); i++) {
        struct lab *lab = paper_lab(ratios[i]);
        struct body beam = lab->bodies[1];
        beam.modes = 24;
        lab_add(lab, "beam", beam);
        struct solve_request request = on_beam(0.1, 0.1);
        request.options.tolerance = 1e-8;
        hard_solve(lab, &request, &result);
        assert_separated(&result);
        double e = result.contacts[0].restitution;
        double first = result.contacts[0].sub_impacts[0].impulse;
        assert_true(e >= -1.0 && e <= 1.0);
        /* the promise at tolerances of 1e-8 and less */
        measured("closure", closure_share(&result, 0.0), 0.0, 1e-9);
        if (ratios[i] == 0.0)
            assert_true(result.energy.damping == 0.0);
        else
            assert_true(result.energy.damping > 0.0);
        request.options.method = PERCUSS_METHOD_CVODE;
        request.options.tolerance = 1e-6;
        hard_solve(lab, &request, &result);
        /* the reference's own tolerance on the first sub-impact; more is amplified later */
        measured_relative("first", first, result.contacts[0].sub_impacts[0].impulse, 1e-6);
        measured("e", e, result.contacts[0].restitution, 1e-4);
        lab_free(lab);
    }
}

/* A soft ball stays longer than the beam's slowest period: the beam follows like a rigid body, and
 * the more so the softer it is. CVODE agrees where both move. */
static void a_contact_longer_than_the_lowest_period(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    double previous = 0.0;
    for (int decade = 7; decade >= 3; decade--) {
        struct material soft = {"soft", pow(10.0, decade), 0.3, 1100.0, INFINITY, 0.0};
        lab_add(lab, "ball", make_sphere(soft, 0.015));
        struct solve_request request = on_beam(0.0, 0.01);
        request.options.tolerance = 1e-6;
        request.options.horizon = 10.0;
        lab_solve(lab, &request, &result);
        assert_separated(&result);
        double e = result.contacts[0].restitution;
        const struct sub_impact *sub = result.contacts[0].sub_impacts;
        if (getenv("PERCUSS_MEASURE"))
            print_message("    E 1e%d: e %.9f, contact %.4g s\n", decade, e, sub->end - sub->start);
        /* the first bending period of this beam is 1/90 s */
        assert_true(decade > 5 || sub->end - sub->start > 1.0 / 90.0);
        assert_true(e <= 1.0 + 1e-6);
        if (decade < 6)
            assert_true(e >= previous - 1e-6);
        previous = e;
    }
    /* adiabatic: the ripple left behind falls faster than any power that is measured here */
    measured("e of the softest", previous, 1.0, 1e-4);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_contact_at_the_node_of_the_only_mode),
        cmocka_unit_test(a_node_among_many_modes),
        cmocka_unit_test(five_thousand_modes),
        cmocka_unit_test(frequencies_equal_to_15_digits),
        cmocka_unit_test(equal_frequencies_in_two_planes),
        cmocka_unit_test(damping_from_0_to_0_99),
        cmocka_unit_test(a_contact_longer_than_the_lowest_period),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
