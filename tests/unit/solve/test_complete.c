/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/finite_element.c: requests answered by complete finite elements. */
#include "physics/support.h"

static struct solve_result result;

static struct lab *shapes(void)
{
    struct lab *lab = lab_create();
    struct material soft = ALUMINIUM;
    soft.yield = 205e6;
    struct body tipped = make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0);
    tipped.tip_radius = 0.02;
    struct body by_rate = make_sphere(soft, 0.015);
    by_rate.yield_rate = (struct yield_rate){.reference = 6500.0, .exponent = 4.0};
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "soft-ball", make_sphere(soft, 0.015));
    lab_add(lab, "by-rate", by_rate);
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "tipped", tipped);
    return lab;
}

static struct solve_request on_rod(const char *ball, const char *rod, double speed)
{
    struct solve_request request = strike(sphere_spot(ball, 0.015), end_spot(rod, 1.0), speed);
    request.options.contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    request.options.tolerance = 0.02;
    return request;
}

static void answers_in_the_terms_of_all_models(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = on_rod("ball", "rod", 0.3);
    lab_solve(lab, &request, &result);
    const struct solve_contact_result *contact = &result.contacts[0];
    double e = contact->restitution;
    assert_int_equal(result.contact_model, PERCUSS_CONTACT_COMPLETE_FE);
    assert_int_equal(result.end_reason, PERCUSS_END_SEPARATED);
    assert_true(result.tolerance_met && result.restitution_modes > 1e-4);
    assert_string_equal(result.bodies[0].theory, "finite elements");
    /* the restitution, the impulse, its list and the velocities say the same */
    double sum = 0.0;
    for (size_t i = 0; i < contact->sub_impacts_listed; i++)
        sum += contact->sub_impacts[i].impulse;
    measured_relative("sum of the list", sum, contact->impulse, 1e-12);
    const struct sub_impact *first = &contact->sub_impacts[0];
    assert_true(first->compression_impulse > 0.4 * first->impulse);
    assert_true(first->compression_impulse < first->impulse);
    assert_true(first->start < first->compression_end && first->compression_end < first->end);
    measured_relative("e", contact->impulse / contact->impulse_compression - 1.0, e, 1e-12);
    double after[3];
    sub3(result.bodies[0].velocity, result.bodies[1].velocity, after);
    measured_relative("velocity after", dot3(request.contacts[0].normal, after), 0.3 * e, 1e-9);
    measured("energy", result.energy.closure / result.energy.available, 0.0, 1e-5);
    /* the modal model of the same scene, which shares nothing with it: waves, Hertz, and the
     * matched compliance of rod and sphere. Eight elements across the patch leave 0.0005. */
    request.options.contact_model = PERCUSS_CONTACT_HERTZ;
    request.options.compliance = PERCUSS_COMPLIANCE_MATCHED;
    request.options.tolerance = 1e-4;
    lab_solve(lab, &request, &result);
    measured("modal", result.contacts[0].restitution, e, 0.002);
    lab_free(lab);
}

static void a_gap_delays_it(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = on_rod("ball", "rod", 0.5);
    lab_solve(lab, &request, &result);
    double start = result.contacts[0].sub_impacts[0].start;
    double e = result.contacts[0].restitution;
    request.contacts[0].gap = 1e-4;
    lab_solve(lab, &request, &result);
    measured("start", result.contacts[0].sub_impacts[0].start - start, 2e-4, 1e-12);
    measured("restitution", result.contacts[0].restitution, e, 0.0);
    lab_free(lab);
}

static void two_spheres_dissipate_by_flow_only(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), sphere_spot("soft-ball", 0.015), 0.3);
    request.options.contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    request.options.tolerance = 0.02;
    lab_solve(lab, &request, &result);
    /* docs/lab/complete-fe.md: 0.6958 as the limit; four and eight elements: 0.7098, 0.6996 */
    measured("e", result.contacts[0].restitution, 0.6958, 0.01);
    assert_true(result.energy.plastic > 0.3 * result.energy.available);
    /* what the steps gain or lose counts as the rebound's */
    double e = result.contacts[0].restitution;
    double changed = e + result.restitution_time;
    double lost = fabs(result.energy.closure) / result.energy.available;
    measured_relative("steps", changed * changed - e * e, lost, 1e-6);
    assert_true(result.restitution_time > 0.0);
    assert_null(strstr(result.reason, "rate of strain"));
    /* each point by its own rate: some 4 1/s raise the yield 1.16 times, and e ~ yield^(5/8) */
    request = strike(sphere_spot("ball", 0.015), sphere_spot("by-rate", 0.015), 0.3);
    request.options.contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    request.options.tolerance = 0.02;
    lab_solve(lab, &request, &result);
    measured("by the rate", result.contacts[0].restitution, e * pow(1.16, 0.625), 0.03);
    assert_true(result.contacts[0].restitution > e + 0.02);
    assert_non_null(strstr(result.reason, "its own rate of strain"));
    lab_free(lab);
}

static void refused(struct lab *lab, const struct solve_request *request, const char *words)
{
    solve(lab->workspace, &lab->means, request, &result);
    if (result.status != PERCUSS_BAD_REQUEST && result.status != PERCUSS_UNSUPPORTED_GEOMETRY)
        fail_msg("%s: status %d", words, (int)result.status);
    if (!strstr(result.fault.text, words))
        fail_msg("'%s' is not in: %s", words, result.fault.text);
}

static void what_is_not_axisymmetric_is_named(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = on_rod("ball", "beam", 0.3);
    refused(lab, &request, "beam: shape");
    request = on_rod("ball", "tipped", 0.3);
    refused(lab, &request, "tip_radius");
    request = on_rod("ball", "rod", 0.3);
    for (int i = 0; i < 3; i++) {
        double along = request.contacts[0].normal[i];
        request.bodies[0].velocity[i] += 0.01 * (fabs(along) < 0.5);
    }
    refused(lab, &request, "velocity");
    request = on_rod("ball", "rod", 0.3);
    request.contacts[0].gap_acceleration = -9.81;
    refused(lab, &request, "gap_acceleration");
    request = on_rod("ball", "rod", 0.3);
    request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    refused(lab, &request, "compliance");
    request = on_rod("ball", "rod", 0.3);
    request.options.method = PERCUSS_METHOD_CVODE;
    refused(lab, &request, "method");
    request = on_rod("ball", "rod", 0.3);
    double w = 1.0;
    request.delassus = &w;
    refused(lab, &request, "delassus");
    request = strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), 0.3);
    request.options.contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    for (int i = 0; i < 3; i++) {
        double sideways = fabs(request.contacts[0].normal[i]) < 0.5 ? 1e-3 : 0.0;
        request.contacts[0].point[i] += sideways;
        request.bodies[0].position[i] += sideways;
    }
    refused(lab, &request, "contacts[0].point");
    lab_free(lab);
}

static bool stop(void *context, double done)
{
    *(double *)context = done;
    return done < 0.01;
}

static void a_watch_stops_it(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    double done = 0.0;
    lab->means.watch = (struct watch){stop, &done};
    struct solve_request request = on_rod("ball", "rod", 0.3);
    request.options.tolerance = 1e-4;
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &result), PERCUSS_TIMEOUT);
    assert_true(done >= 0.01 && done < 0.1);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_in_the_terms_of_all_models),
        cmocka_unit_test(a_gap_delays_it),
        cmocka_unit_test(two_spheres_dissipate_by_flow_only),
        cmocka_unit_test(what_is_not_axisymmetric_is_named),
        cmocka_unit_test(a_watch_stops_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
