/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Matched local compliance in an answer: what it changes on a rod, where it is not known, and when
 * it is left aside. */
#include "physics/support.h"
#include "solve/repeat.h"

static struct lab *matched_lab(void)
{
    struct lab *lab = lab_create();
    lab->set.compliance = PERCUSS_COMPLIANCE_MATCHED;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    return lab;
}

static void solve_with(struct lab *lab, struct solve_request request,
                       enum percuss_compliance compliance, struct solve_result *result)
{
    request.options.compliance = compliance;
    request.options.tolerance = 1e-8;
    lab_solve(lab, &request, result);
    measured("closure", result->energy.closure / result->energy.available, 0.0, 1e-9);
}

/* Against both bodies completely meshed, elastic: .7746 .7226 .6335 .5901 with discretisation
 * errors below 0.001 (docs/lab/complete-fe.md); the 1-D rod has no lateral inertia, so 0.001 more. */
static void a_rod_as_the_complete_bodies_say(void **state)
{
    (void)state;
    static const double speeds[] = {0.05, 0.1, 0.3, 0.5};
    static const double complete[] = {0.7746, 0.7226, 0.6335, 0.5901};
    static struct solve_result result;
    struct lab *lab = matched_lab();
    for (size_t i = 0; i < COUNT(speeds); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), speeds[i]);
        solve_with(lab, request, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
        double half_space = result.contacts[0].restitution;
        assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_HALF_SPACE);
        solve_with(lab, request, PERCUSS_COMPLIANCE_DEFAULT, &result);
        assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_MATCHED);
        measured("e", result.contacts[0].restitution, complete[i], 0.002);
        measured("change", result.contacts[0].restitution - half_space, -0.01, 0.007);
    }
    lab_free(lab);
}

/* Whether the reply says that the beam's matched compliance is not known; at this tolerance it
 * warns of what the ball leaves out and of more modes than are tried, too. */
static bool warns_of_compliance(const struct solve_result *result)
{
    for (size_t i = 0; i < result->warning_count; i++)
        if (strstr(result->warnings[i], "options.compliance: matched"))
            return true;
    return false;
}

/* A beam's side holds its own (model/beam_statics.c) whatever is asked, so that the choice is the
 * ball's. Of a beam without shear nothing is known: half-space, and the reply says so when asked
 * for more. */
static void beams_know_their_sides(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = matched_lab();
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
    solve_with(lab, request, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
    double e = result.contacts[0].restitution;
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_HALF_SPACE);
    solve_with(lab, request, PERCUSS_COMPLIANCE_DEFAULT, &result);
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_MATCHED);
    measured("e", result.contacts[0].restitution, e, 0.003);
    assert_true(result.contacts[0].restitution != e);
    solve_with(lab, request, PERCUSS_COMPLIANCE_MATCHED, &result);
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_MATCHED);
    assert_false(warns_of_compliance(&result));
    /* without shear */
    struct body textbook = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    textbook.theory = THEORY_EULER_BERNOULLI;
    lab_add(lab, "beam", textbook);
    solve_with(lab, request, PERCUSS_COMPLIANCE_DEFAULT, &result);
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_HALF_SPACE);
    assert_false(warns_of_compliance(&result));
    solve_with(lab, request, PERCUSS_COMPLIANCE_MATCHED, &result);
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_HALF_SPACE);
    assert_true(warns_of_compliance(&result));
    lab_free(lab);
}

/* A contact that is wide beside the beam's thickness: its law is too stiff for what the side has
 * less than a half-space, which is left aside then, with its size among the model's error. */
static void a_wide_contact_leaves_it_aside(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = matched_lab();
    struct body thin = make_body(&beam_kind, ALUMINIUM);
    thin.width = thin.height = 0.006;
    thin.length = 0.3;
    lab_add(lab, "ball", make_sphere(STEEL, 0.1));
    lab_add(lab, "beam", thin);
    struct solve_request request =
        strike(sphere_spot("ball", 0.1), side_spot("beam", 0.0, 0.003, 0.0), 20.0);
    request.options.contact_model = PERCUSS_CONTACT_HERTZ;
    lab_solve(lab, &request, &result);
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_HALF_SPACE);
    measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-3);
    /* 0.6 of the side and 0.3 of the ball, by their radii */
    assert_true(result.restitution_model > 0.05);
    lab_free(lab);
}

/* Bodies that do not vibrate hold nothing twice: Hertz's collision unless asked otherwise, and then
 * another duration but no loss. */
static void rigid_bodies_stay_hertz_s(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = matched_lab();
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), sphere_spot("ball", 0.015), 0.3);
    solve_with(lab, request, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
    double duration = result.contacts[0].end_time;
    solve_with(lab, request, PERCUSS_COMPLIANCE_DEFAULT, &result);
    measured_relative("duration", result.contacts[0].end_time, duration, 0.0);
    measured("e", result.contacts[0].restitution, 1.0, 1e-12);
    solve_with(lab, request, PERCUSS_COMPLIANCE_MATCHED, &result);
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_MATCHED);
    assert_true(fabs(result.contacts[0].end_time / duration - 1.0) > 1e-4);
    measured("e", result.contacts[0].restitution, 1.0, 1e-8);
    lab_free(lab);
}

/* Off the axis of a rigid cylinder the correction is not known (a rod refuses such a hit). */
static void only_central_hits(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = matched_lab();
    struct body cylinder = make_bar(&cylinder_kind, ALUMINIUM, 0.020, 0.040);
    cylinder.rigid = true;
    lab_add(lab, "block", cylinder);
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), end_spot("block", 0.040), 0.3);
    for (int beside = 0; beside < 2; beside++) {
        request.bodies[0].position[0] += beside ? 0.005 : 0.0;
        request.contacts[0].point[0] += beside ? 0.005 : 0.0;
        solve_with(lab, request, PERCUSS_COMPLIANCE_MATCHED, &result);
        assert_int_equal(result.compliance,
                         beside ? PERCUSS_COMPLIANCE_HALF_SPACE : PERCUSS_COMPLIANCE_MATCHED);
    }
    lab_free(lab);
}

/* At 100 m/s (elastic, far beyond validity) a contact nearly as wide as a thin rod is too stiff for
 * a negative series compliance: half-space, and the reason says so. */
static void too_stiff_contacts_do_without(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = matched_lab();
    lab_add(lab, "thin", make_bar(&rod_kind, ALUMINIUM, 0.002, 1.0));
    struct solve_request request = strike(sphere_spot("ball", 0.015), end_spot("thin", 1.0), 100.0);
    request.options.contact_model = PERCUSS_CONTACT_HERTZ;
    request.options.tolerance = 1e-4;
    lab_solve(lab, &request, &result);
    assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_HALF_SPACE);
    assert_non_null(strstr(result.reason, "too negative"));
    lab_free(lab);
}

/* The sphere's compliance goes with the logarithm of the patch: also the slowest touch is answered
 * at once, and e stays smooth in the speed. */
static void the_slowest_touch(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = matched_lab();
    double last = 1.0;
    for (double speed = 1e-9; speed < 1e-3; speed *= 10.0) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), speed);
        request.options.tolerance = 1e-4;
        lab_solve(lab, &request, &result);
        assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_MATCHED);
        assert_true(result.contacts[0].restitution <= last + 1e-4);
        last = result.contacts[0].restitution;
    }
    lab_free(lab);
}

/* A sphere's part depends on the speed: a sample of an ensemble has the bits that it has alone,
 * whatever its worker solved before. */
static void a_sample_has_its_own_compliance(void **state)
{
    (void)state;
    struct lab *lab = matched_lab();
    struct repeat *alone = repeat_create(), *busy = repeat_create();
    struct solution_model model;
    struct repeat_outcome first, other, again;
    struct fault fault;
    struct solve_request slow = strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), 0.2);
    struct solve_request fast = strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), 0.4);
    assert_int_equal(repeat_search(alone, &lab->means, &slow, 0, &model, &first, &fault),
                     PERCUSS_OK);
    repeat_solve(alone, &lab->means, &slow, 0, &model, false, &first, &fault);
    repeat_solve(busy, &lab->means, &fast, 0, &model, false, &other, &fault);
    repeat_solve(busy, &lab->means, &slow, 0, &model, true, &again, &fault);
    assert_int_equal(again.status, PERCUSS_OK);
    assert_true(other.restitution != first.restitution);
    assert_true(again.restitution == first.restitution && again.impulse == first.impulse);
    repeat_free(alone);
    repeat_free(busy);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rod_as_the_complete_bodies_say),
        cmocka_unit_test(beams_know_their_sides),
        cmocka_unit_test(a_wide_contact_leaves_it_aside),
        cmocka_unit_test(rigid_bodies_stay_hertz_s),
        cmocka_unit_test(only_central_hits),
        cmocka_unit_test(too_stiff_contacts_do_without),
        cmocka_unit_test(the_slowest_touch),
        cmocka_unit_test(a_sample_has_its_own_compliance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
