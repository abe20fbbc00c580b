/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Blows beside the axis of a rectangular bar: it twists away under the ball. */
#include "model/bar.h"
#include "physics/support.h"

/* 300 x 40 x 4 mm of aluminium, a steel ball of 8 mm radius at 0.5 m/s. */
static struct body strip_body(enum support left, enum support right)
{
    struct body strip = make_supported(make_bar(&beam_kind, ALUMINIUM, 0.0, 0.3), left, right);
    strip.width = 0.04;
    strip.height = 0.004;
    strip.shear_rule = SHEAR_COWPER; /* Hutchinson's is negative for so wide a section */
    return strip;
}

static struct lab *lab_of_strip(struct body strip)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.008));
    lab_add(lab, "strip", strip);
    return lab;
}

static struct solve_request blow(double x, double y, double tolerance)
{
    struct spot at = {"strip", {x, y, 0.002}, {0.0, 0.0, 1.0}, 0.0};
    struct solve_request request = strike(sphere_spot("ball", 0.008), at, 0.5);
    request.options.tolerance = tolerance;
    return request;
}

static double restitution(struct lab *lab, const struct solve_request *request,
                          struct solve_result *result)
{
    lab_solve(lab, request, result);
    return result->contacts[0].restitution;
}

/* Against an independent solution: bending by Timoshenko's elements, twist by cubic ones with
 * Vlasov's warping stiffness and inertia, modes to 250 kHz, static compliance of the rest in
 * series, the force stepped at 50 ns, the warping constant by numerical integration over the
 * section. 5 mm beside the axis e is 0.3082 with 120 elements and 0.3144 with 240: 0.3164 by
 * extrapolation; 10 mm beside it 0.06986. Without twist they would be 0.512 and more, without
 * warping 0.104 and 0.084. */
static void a_strip_struck_beside_its_axis_twists_away(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_strip(strip_body(SUPPORT_FREE, SUPPORT_FREE));
    struct solve_request request = blow(0.0, 0.005, 1e-5);
    double e = restitution(lab, &request, &result);
    assert_true(result.tolerance_met);
    /* the third of three sub-impacts amplifies: the extrapolation is good to 5e-4 */
    measured("e, 5 mm", e, 0.3164, 1e-3);
    /* with 240 elements; 120 give 3e-5 less */
    measured_relative("first impulse", result.contacts[0].sub_impacts[0].impulse, 0.00699843, 5e-5);
    measured("second blow", result.contacts[0].sub_impacts[1].start, 0.5229e-3, 2e-7);
    measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-6);
    /* the other side is its mirror image, and coarse tolerances keep their promise */
    request = blow(0.0, -0.005, 1e-5);
    measured("mirrored", restitution(lab, &request, &result), e, 1e-10);
    for (double tolerance = 1e-2; tolerance > 1e-5; tolerance /= 10.0) {
        request = blow(0.0, 0.005, tolerance);
        measured("e, coarser", restitution(lab, &request, &result), e, tolerance);
        assert_true(fabs(result.contacts[0].restitution - e) <=
                    result.restitution_modes + result.restitution_time);
    }
    request = blow(0.0, 0.010, 1e-5);
    /* steps and elements of the independent solution move it by some 1e-5 */
    measured("e, 10 mm", restitution(lab, &request, &result), 0.069856, 5e-5);
    lab_free(lab);
}

/* Equal modes, two integrations: every pair of supports, along and beside, damped. */
static void modal_and_cvode_agree(void **state)
{
    (void)state;
    static struct solve_result modal, cvode;
    static const enum support ends[][2] = {{SUPPORT_FREE, SUPPORT_FREE},
                                           {SUPPORT_CLAMPED, SUPPORT_FREE},
                                           {SUPPORT_PINNED, SUPPORT_FREE},
                                           {SUPPORT_PINNED, SUPPORT_PINNED}};
    for (size_t i = 0; i < COUNT(ends); i++) {
        struct body strip = strip_body(ends[i][0], ends[i][1]);
        strip.modes = 12;
        strip.damping = i % 2 ? 0.01 : 0.0;
        struct lab *lab = lab_of_strip(strip);
        struct solve_request request = blow(0.03, 0.011, 1e-7);
        lab_solve(lab, &request, &modal);
        assert_int_equal(modal.bodies[1].modes, 24);
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &cvode);
        /* tolerance 1e-7 each, amplified by a sequence */
        measured("e", modal.contacts[0].restitution, cvode.contacts[0].restitution, 1e-5);
        lab_free(lab);
    }
}

/* Without a rigid motion of the strip the inverse mass is the ball's alone, held or not; twist is
 * in the modes, and the farther from the axis, the softer the strip. */
static void held_ends_hold_the_twist(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_strip(strip_body(SUPPORT_PINNED, SUPPORT_PINNED));
    double last = INFINITY;
    for (double y = 0.0; y < 0.016; y += 0.005) {
        struct solve_request request = blow(0.0, y, 1e-4);
        lab_solve(lab, &request, &result);
        const struct sub_impact *first = result.contacts[0].sub_impacts;
        measured_relative("ball alone", 1.0 / result.contacts[0].inverse_effective_mass,
                          7800.0 * 4.0 / 3.0 * M_PI * pow(0.008, 3.0), 1e-12);
        assert_true(first->peak_force < 0.95 * last);
        last = first->peak_force;
    }
    lab_free(lab);
}

static struct body_state *copy_state(const struct body_state *state)
{
    struct body_state *copy = malloc(body_state_size(state));
    assert_non_null(copy);
    memcpy(copy, state, body_state_size(state));
    return copy;
}

/* The twist rings on in the state: it holds its energy, and the next blow finds it; one on the axis
 * does not, but hands it on. */
static void the_twist_rings_on(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_strip(strip_body(SUPPORT_FREE, SUPPORT_FREE));
    struct solve_request request = blow(0.02, 0.008, 1e-5);
    double silent = restitution(lab, &request, &result);
    double held = result.bodies[1].vibration;
    struct body_state *ringing = copy_state(result.bodies[1].state_after);
    assert_true(ringing->count[BAR_TWIST] > 0);
    request.bodies[1].state = ringing;
    request.bodies[1].elapsed = 0.001;
    double e = restitution(lab, &request, &result);
    assert_true(fabs(e - silent) > 1e-2);
    double approach = 0.5 * 0.25 / result.contacts[0].inverse_effective_mass;
    measured_relative("available", result.energy.available, approach + held, 1e-10);
    measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-5);
    struct solve_request central = blow(0.0, 0.0, 1e-5);
    central.bodies[1].state = ringing;
    restitution(lab, &central, &result);
    const struct body_state *after = result.bodies[1].state_after;
    assert_int_equal(after->count[BAR_TWIST], ringing->count[BAR_TWIST]);
    const double *before = body_state_family(ringing, BAR_TWIST);
    const double *later = body_state_family(after, BAR_TWIST);
    assert_true(before[0] != later[0]);
    free(ringing);
    lab_free(lab);
}

/* A hit beside the axis of an end face: longitudinal waves and bending together, no twist. */
static void an_end_hit_beside_the_axis_bends_and_pushes(void **state)
{
    (void)state;
    static struct solve_result modal, cvode;
    struct body strip = strip_body(SUPPORT_FREE, SUPPORT_FREE);
    strip.modes = 12;
    struct lab *lab = lab_of_strip(strip);
    struct spot at = {"strip", {0.15, 0.012, 0.0005}, {1.0, 0.0, 0.0}, 0.0};
    struct solve_request request = strike(sphere_spot("ball", 0.008), at, 0.5);
    request.options.tolerance = 1e-7;
    lab_solve(lab, &request, &modal);
    assert_int_equal(modal.bodies[1].modes, 36);
    assert_int_equal(modal.bodies[1].state_after->count[BAR_TWIST], 0);
    request.options.method = PERCUSS_METHOD_CVODE;
    lab_solve(lab, &request, &cvode);
    /* tolerance 1e-7 each, amplified by a sequence */
    measured("e", modal.contacts[0].restitution, cvode.contacts[0].restitution, 1e-5);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_strip_struck_beside_its_axis_twists_away),
        cmocka_unit_test(modal_and_cvode_agree),
        cmocka_unit_test(held_ends_hold_the_twist),
        cmocka_unit_test(the_twist_rings_on),
        cmocka_unit_test(an_end_hit_beside_the_axis_bends_and_pushes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
