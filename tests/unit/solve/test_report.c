/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/report.c and validity.c: what an answer says about itself. */
#include "physics/support.h"

static struct solve_result result;

static struct lab *shapes(void)
{
    struct lab *lab = lab_create();
    struct body love = make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0);
    struct body slim = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    struct material soft = ALUMINIUM;
    love.lateral_inertia = true;
    slim.theory = THEORY_EULER_BERNOULLI;
    soft.yield = 205e6;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "love", love);
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "slim", slim);
    lab_add(lab, "soft", make_bar(&rod_kind, soft, 0.010, 1.0));
    lab_add(lab, "wall", make_body(&half_space_kind, STEEL));
    lab_add(lab, "bead", make_bar(&rod_kind, STEEL, 0.02, 0.04));
    return lab;
}

static bool warns(const char *words)
{
    for (size_t i = 0; i < result.warning_count; i++)
        if (strstr(result.warnings[i], words))
            return true;
    return false;
}

static struct solve_request on_end(const char *id, double speed)
{
    return strike(sphere_spot("ball", 0.015), end_spot(id, 1.0), speed);
}

static void names_theories_and_models(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request requests[] = {
        on_end("rod", 0.1), on_end("love", 0.1),
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.1),
        strike(sphere_spot("ball", 0.015), side_spot("slim", 0.0, 0.010, 0.0), 0.1)};
    static const char *const theories[] = {"rod", "rayleigh-love", "timoshenko", "euler-bernoulli"};
    for (size_t i = 0; i < COUNT(requests); i++) {
        lab_solve(lab, &requests[i], &result);
        assert_string_equal(result.bodies[0].id, "ball");
        assert_string_equal(result.bodies[0].theory, "rigid");
        assert_string_equal(result.bodies[1].theory, theories[i]);
        assert_true(result.bodies[0].rigid && !result.bodies[1].rigid);
        assert_true(result.bodies[1].modes > 0);
        assert_int_equal(result.contact_model, PERCUSS_CONTACT_HERTZ);
        assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_HALF_SPACE);
        assert_int_equal(result.method, PERCUSS_METHOD_MODAL);
        assert_true(strlen(result.reason) > 20);
        assert_true(result.omitted_error > 0.0 && result.omitted_error < 1e-2);
        assert_string_equal(result.fault.text, "");
    }
    /* Hutchinson 2001 */
    lab_solve(lab, &requests[2], &result);
    measured("shear factor", result.bodies[1].shear_factor,
             6.0 * 1.33 * 1.33 / (7.0 + 12.0 * 0.33 + 4.0 * 0.33 * 0.33), 1e-15);
    lab_free(lab);
}

/* A short stiff rod rings far above the contact's frequency: it is rigid within the tolerance. */
static void a_compact_rod_is_rigid(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = strike(sphere_spot("ball", 0.015), end_spot("bead", 0.04), 0.02);
    request.options.tolerance = 1e-2;
    lab_solve(lab, &request, &result);
    assert_true(result.bodies[1].rigid && result.bodies[1].modes == 0);
    double e = result.contacts[0].restitution;
    assert_true(result.tolerance_met);
    request.options.tolerance = 1e-7;
    lab_solve(lab, &request, &result);
    assert_false(result.bodies[1].rigid);
    measured("e, rigid", e, result.contacts[0].restitution, 1e-2);
    lab_free(lab);
}

/* Why no mode takes part: it is faster than the blow, or has a node there. */
static void tells_why_no_mode_matters(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct body beam = make_bar(&beam_kind, STEEL, 0.010, 1.0);
    lab_add(lab, "left", make_supported(beam, SUPPORT_CLAMPED, SUPPORT_FREE));
    lab_add(lab, "right", make_supported(beam, SUPPORT_FREE, SUPPORT_PINNED));
    struct solve_request cases[] = {
        strike(sphere_spot("ball", 0.015), side_spot("left", -0.5, 0.010, 0.0), 0.1),
        strike(sphere_spot("ball", 0.015), side_spot("right", 0.5, 0.010, 0.0), 0.1),
        strike(sphere_spot("ball", 0.015), end_spot("bead", 0.04), 0.02)};
    static const char *const reasons[] = {
        "the modes of left have a node at the contact, where it is held: static flexibility only",
        "the modes of right have a node at the contact, where it is held",
        "no mode takes enough of the blow to matter (lowest "};
    for (size_t i = 0; i < COUNT(cases); i++) {
        cases[i].options.tolerance = 1e-2;
        lab_solve(lab, &cases[i], &result);
        if (!strstr(result.reason, reasons[i]))
            fail_msg("%zu: %s", i, result.reason);
    }
    /* the free end moves */
    struct solve_request tip =
        strike(sphere_spot("ball", 0.015), side_spot("left", 0.499, 0.010, 0.0), 0.1);
    lab_solve(lab, &tip, &result);
    assert_null(strstr(result.reason, "node"));
    lab_free(lab);
}

static void warns_where_models_end(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = on_end("soft", 0.3);
    request.options.contact_model = PERCUSS_CONTACT_HERTZ;
    lab_solve(lab, &request, &result);
    assert_true(warns("yield") && warns("soft"));
    request = on_end("rod", 0.3);
    lab_solve(lab, &request, &result);
    assert_int_equal(result.warning_count, 0);
    request = on_end("rod", 60.0); /* 1.2 % of 5 km/s */
    lab_solve(lab, &request, &result);
    assert_true(warns("wave speed"));
    request = strike(sphere_spot("ball", 0.015), side_spot("beam", 0.4996, 0.010, 0.0), 0.1);
    lab_solve(lab, &request, &result);
    assert_true(warns("edge"));
    double w = 1.02 * 11.0;
    request = on_end("rod", 0.3);
    request.delassus = &w;
    lab_solve(lab, &request, &result);
    assert_true(warns("delassus"));
    assert_int_equal(result.delassus_source, PERCUSS_DELASSUS_CLIENT);
    request = strike(sphere_spot("ball", 0.015), side_spot("beam", 0.1, 0.010, 0.0), 0.1);
    request.options.compliance = PERCUSS_COMPLIANCE_MATCHED;
    lab_solve(lab, &request, &result);
    assert_false(warns("compliance"));
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_MATCHED);
    struct body textbook = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    textbook.theory = THEORY_EULER_BERNOULLI;
    lab_add(lab, "beam", textbook);
    lab_solve(lab, &request, &result);
    assert_true(warns("compliance"));
    lab_free(lab);
}

/* 0.3 m/s down, `along` along the surface and `spin` about y, on the wall. */
static struct solve_request oblique(double along, double spin)
{
    struct solve_request request = strike(sphere_spot("ball", 0.015), wall_spot("wall"), 0.3);
    request.bodies[0].velocity[0] = along;
    request.bodies[0].angular_velocity[1] = spin;
    return request;
}

/* What counts is the velocity of the point of contact. */
static void warns_of_sliding(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    const double mass = STEEL.density * 4.0 / 3.0 * M_PI * 0.015 * 0.015 * 0.015;
    struct solve_request request = oblique(0.3, 0.0);
    char expected[64];
    lab_solve(lab, &request, &result);
    assert_true(
        warns("slide there at 0.3 m/s, 1 times the approach: without a coefficient of friction"));
    /* sliding ends before Coulomb's bound, 0.3 of the impulse, is reached: m v / 3.5 */
    snprintf(expected, sizeof expected, "%.3g N s", mass * 0.3 / 3.5);
    assert_true(warns(expected) && warns("change that speed by up to 0.3 m/s"));
    request = oblique(3.0, 0.0);
    lab_solve(lab, &request, &result);
    snprintf(expected, sizeof expected, "%.3g N s", 0.3 * result.contacts[0].impulse);
    assert_true(warns(expected));
    snprintf(expected, sizeof expected, "up to %.3g m/s",
             3.5 / mass * 0.3 * result.contacts[0].impulse);
    assert_true(warns(expected));
    request = oblique(0.0, 20.0); /* spins in place */
    lab_solve(lab, &request, &result);
    assert_true(warns("slide there at 0.3 m/s"));
    request = oblique(0.3, 20.0); /* rolls */
    lab_solve(lab, &request, &result);
    assert_int_equal(result.warning_count, 0);
    request = oblique(0.3, -20.0);
    lab_solve(lab, &request, &result);
    assert_true(warns("slide there at 0.6 m/s, 2 times"));
    request = oblique(0.0149, 0.0); /* just below 5 % */
    lab_solve(lab, &request, &result);
    assert_int_equal(result.warning_count, 0);
    lab_free(lab);
}

/* Of the simulator's own bodies it is not known how they move along the surface. */
static void sliding_of_the_simulators_bodies(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = oblique(3.0, 0.0);
    const double mass = STEEL.density * 4.0 / 3.0 * M_PI * 0.015 * 0.015 * 0.015;
    double w = 1.0 / mass;
    request.delassus = &w;
    lab_solve(lab, &request, &result);
    assert_true(warns("slide there at 3 m/s") && !warns("change that speed"));
    lab_free(lab);
}

/* Forty balls that slide leave room for what is said of the last one only. */
static void every_kind_has_its_place(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    enum { BALLS = 40 };
    struct solve_request request = {.body_count = BALLS + 1, .contact_count = BALLS};
    strcpy(request.bodies[BALLS].id, "wall");
    request.bodies[BALLS].orientation[0] = 1.0;
    for (unsigned i = 0; i < BALLS; i++) {
        struct solve_body *ball = &request.bodies[i];
        strcpy(ball->id, "ball");
        ball->orientation[0] = 1.0;
        ball->position[0] = 0.1 * i;
        ball->position[2] = 0.015;
        ball->velocity[0] = 1.0;
        ball->velocity[2] = i + 1 < BALLS ? -0.3 : -60.0; /* only the last is fast */
        request.contacts[i] = (struct solve_contact){
            .a = i, .b = BALLS, .point = {0.1 * i, 0.0, 0.0}, .normal = {0.0, 0.0, 1.0}};
    }
    solve(lab->workspace, &lab->means, &request, &result);
    assert_true(result.status == PERCUSS_OK);
    assert_true(warns("contacts[39]: the approach at 60 m/s"));
    assert_false(warns("slide")); /* against the fastest approach of all it is nothing */
    for (unsigned i = 0; i < BALLS; i++)
        request.bodies[i].velocity[0] = 6.0;
    solve(lab->workspace, &lab->means, &request, &result);
    assert_true(warns("contacts[0]: the bodies slide"));
    assert_true(warns("contacts[39]: the approach at 60 m/s is more than 1 % of the wave speed"));
    lab_free(lab);
}

/* Waves into the half-space: 1.13 (v/c)^(3/5) of the energy (test_wall.c), half of it in e. Where
 * that matters they are in the model; otherwise all of it is the error of what is left out. A tenth
 * of the sphere's 0.01 v/c is beyond any tolerance below it: the reply says so. */
static void states_what_it_leaves_out(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = strike(sphere_spot("ball", 0.015), wall_spot("wall"), 0.5);
    double c = sqrt(210e9 / 7800.0);
    double loss = 0.5 * 1.13 * pow(0.5 / c, 0.6);
    double sphere = 0.01 * 0.5 / c;
    request.options.tolerance = 1e-3;
    lab_solve(lab, &request, &result);
    measured_relative("e", 1.0 - result.contacts[0].restitution, loss, 0.01);
    assert_non_null(strstr(result.reason, "waves leave through the half-space"));
    assert_true(result.tolerance_met && result.warning_count == 0);
    assert_true(result.omitted_error > sphere && result.omitted_error < sphere + 1e-3 * loss);
    request.options.tolerance = 0.05;
    lab_solve(lab, &request, &result);
    measured("e", result.contacts[0].restitution, 1.0, 1e-12);
    assert_null(strstr(result.reason, "waves"));
    /* estimates of single contacts are taken two and a half times */
    measured_relative("error", result.restitution_modes, 2.5 * loss, 0.01);
    measured_relative("omitted", result.omitted_error, 2.5 * loss + sphere, 0.01);
    assert_true(result.tolerance_met && result.warning_count == 0);
    request.options.tolerance = 0.5 * sphere;
    lab_solve(lab, &request, &result);
    assert_int_equal(result.warning_count, 1);
    assert_true(warns("model.omitted_error: waves"));
    lab_free(lab);
}

/* An unmet tolerance names what stands in its way. */
static void an_unmet_tolerance_has_its_reason(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct body three = make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0);
    struct body cantilever = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    three.modes = 3;
    cantilever.supports[0] = SUPPORT_CLAMPED;
    lab_add(lab, "three", three);
    lab_add(lab, "cantilever", cantilever);
    lab_add(lab, "long", make_bar(&rod_kind, ALUMINIUM, 0.010, 100.0));
    lab_add(lab, "heavy", make_sphere(STEEL, 0.050));
    lab_add(lab, "grain", make_sphere(STEEL, 0.0005));
    const struct spot grain = sphere_spot("grain", 0.0005);
    const struct spot heavy = sphere_spot("heavy", 0.050);
    struct {
        struct solve_request request;
        double tolerance;
        const char *reason;
    } cases[] = {
        {on_end("three", 0.3), 1e-3, "the catalogue fixes the number of modes"},
        /* a grain is faster than 1200 modes of 100 m */
        {strike(grain, end_spot("long", 100.0), 5.0), 1e-3, "the most modes that are tried"},
        /* hundreds of sub-impacts */
        {strike(heavy, side_spot("cantilever", 0.49, 0.010, 0.0), 0.3), 1e-5,
         "the effort allowed is spent"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        cases[i].request.options.tolerance = cases[i].tolerance;
        solve(lab->workspace, &lab->means, &cases[i].request, &result);
        assert_false(result.tolerance_met);
        assert_true(warns(cases[i].reason));
        assert_false(warns("amplifies"));
    }
    lab_free(lab);
}

/* de/dv against a difference of whole solutions. */
static void conditioning_is_a_derivative(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    double e[2];
    struct solve_request request = on_end("rod", 0.3);
    request.options.tolerance = 1e-7;
    lab_solve(lab, &request, &result);
    assert_true(isnan(result.restitution_by_speed));
    request.options.conditioning = true;
    lab_solve(lab, &request, &result);
    double slope = result.restitution_by_speed;
    for (int i = 0; i < 2; i++) {
        struct solve_request shifted = on_end("rod", i ? 0.303 : 0.297);
        shifted.options.tolerance = 1e-8;
        lab_solve(lab, &shifted, &result);
        e[i] = result.contacts[0].restitution;
    }
    /* step of 1 %: second order, 1e-4 relative; the tolerances 1e-8 over 6e-3 m/s */
    measured_relative("slope", slope, (e[1] - e[0]) / 0.006, 1e-3);
    lab_free(lab);
}

static void refusals_leave_a_clean_answer(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = on_end("rod", -0.3);
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &result),
                     PERCUSS_NOT_APPROACHING);
    assert_false(result.complete);
    assert_int_equal(result.contact_count, 0);
    assert_true(strlen(result.fault.text) > 0);
    /* and the next request is answered as ever */
    request = on_end("rod", 0.3);
    lab_solve(lab, &request, &result);
    measured("e", result.contacts[0].restitution, 0.6433, 1e-3);
    lab_free(lab);
}

/* Far below the default tolerance they differ in the tenth digit and behind. */
static void a_range_has_two_ends(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
    request.options.tolerance = 1e-9;
    lab_solve(lab, &request, &result);
    double low = NAN, high = NAN;
    for (size_t i = 0; i < result.warning_count; i++) {
        const char *range = strstr(result.warnings[i], "span ");
        if (range)
            assert_int_equal(sscanf(range, "span %lf to %lf", &low, &high), 2);
    }
    assert_true(low < high && high - low < 1e-8);
    /* the range is told to the 13th digit */
    double e = result.contacts[0].restitution;
    assert_true(low - 1e-13 <= e && e <= high + 1e-13);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_theories_and_models),
        cmocka_unit_test(a_compact_rod_is_rigid),
        cmocka_unit_test(tells_why_no_mode_matters),
        cmocka_unit_test(warns_where_models_end),
        cmocka_unit_test(warns_of_sliding),
        cmocka_unit_test(sliding_of_the_simulators_bodies),
        cmocka_unit_test(every_kind_has_its_place),
        cmocka_unit_test(states_what_it_leaves_out),
        cmocka_unit_test(an_unmet_tolerance_has_its_reason),
        cmocka_unit_test(conditioning_is_a_derivative),
        cmocka_unit_test(refusals_leave_a_clean_answer),
        cmocka_unit_test(a_range_has_two_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
