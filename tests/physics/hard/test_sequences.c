/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* More than one sub-impact: grazes down to nothing, dozens in a row, bodies that ring already. */
#include "physics/hard/hard.h"
#include "unit/impact/toy_scene.h"

/* A mode of unit amplitude and frequency reaches over a resting gap by delta. While the graze is
 * weak the approach stays the parabola delta - t^2/2, and with d = delta cos^2(x)
 *   P = k delta^(3/2) sqrt(2 delta) int cos^4 = (3 pi/8) sqrt(2) k delta^2.
 * A second contact, apart from it and over long before, is of two rigid bodies: P = 2. */
static void a_graze_of_1e_12_of_the_first_impulse(void **state)
{
    (void)state;
    for (int decade = -3; decade >= -6; decade--) {
        for (int sign = -1; sign <= 1; sign += 2) {
            struct toy toy;
            double delta = sign * pow(10.0, decade);
            double phi[2] = {0.0, 1.0};
            toy_init(&toy, 2);
            toy.gap_rate[0] = -1.0;
            toy.laws[0] = contact_law_hertz(1e6);
            toy.gap[1] = 1.0 - delta;
            toy_ring(&toy, toy_add(&toy, 1, 1, (double[]){1.0}, 0.0, phi), (double[]){1.0},
                     (double[]){0.0});
            struct impact_outcome outcome = toy_run(&toy, 1e-14, 5.0);
            measured("first", outcome.tracks[0].impulse, 2.0, 1e-9);
            assert_int_equal(outcome.tracks[1].count, sign > 0);
            assert_int_equal(outcome.end_reason,
                             sign > 0 ? PERCUSS_END_HORIZON : PERCUSS_END_SEPARATED);
            /* the cosine is no parabola (delta), the graze bends it (delta^(3/2)); 1 - delta is
             * rounded */
            double expected = sign > 0 ? 3.0 * M_PI / 8.0 * sqrt(2.0) * delta * delta : 0.0;
            measured("graze", outcome.tracks[1].impulse, expected,
                     expected * (fabs(delta) + 5.0 * pow(fabs(delta), 1.5) + 1e-7));
            if (sign > 0)
                measured("at", outcome.tracks[1].list[0].compression_end, M_PI, 2e-3);
            toy_free(&toy);
        }
    }
}

static double graze_at(struct lab *lab, double speed, double *first, size_t *count)
{
    static struct solve_result result;
    struct solve_request request = on_beam(0.0, speed);
    request.options.tolerance = 1e-6;
    lab_solve(lab, &request, &result);
    const struct sub_impact *sub = result.contacts[0].sub_impacts;
    *first = sub[0].impulse;
    *count = result.contacts[0].sub_impact_count;
    return *count > 1 && sub[1].start < 2e-3 ? sub[1].impulse : 0.0;
}

/* The paper's beam at 0.31 m/s, with Cowper's shear factor, grazes at 1.415 ms. Down to the speed
 * where the graze vanishes its impulse falls like the square of the distance, as above. */
static void the_graze_of_the_paper_s_beam_vanishes(void **state)
{
    (void)state;
    struct lab *lab = paper_lab(0.0);
    struct body beam = make_cowper(lab->bodies[1]);
    double first;
    size_t count;
    beam.modes = 40; /* one model for all speeds */
    lab_add(lab, "beam", beam);
    double with = 0.31;
    double without = 0.303;
    if (!(graze_at(lab, with, &first, &count) > 0.0))
        fail_msg("no graze at 0.31 m/s");
    assert_true(graze_at(lab, without, &first, &count) == 0.0);
    for (int i = 0; i < 45; i++) {
        double middle = 0.5 * (with + without);
        if (graze_at(lab, middle, &first, &count) > 0.0)
            with = middle;
        else
            without = middle;
    }
    double last = 0.0;
    /* nearer the steps of the first blow, which change with the speed, move it by a hundredth */
    for (double distance = 1e-4; distance > 3e-7; distance *= 0.1) {
        double share = graze_at(lab, with + distance, &first, &count) / first;
        if (last > 0.0) /* the square, bent by the distance itself */
            measured_relative("share", share, 0.01 * last, 0.1);
        last = share;
    }
    assert_true(last > 0.0 && last < 1e-8);
    lab_free(lab);
}

/* A heavy ball on a light beam that flaps against it: dozens of sub-impacts. Passive, and the first
 * two as CVODE finds them. */
static void dozens_of_sub_impacts(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    struct body beam =
        make_supported(make_bar(&beam_kind, ALUMINIUM, 0.001, 0.5), SUPPORT_PINNED, SUPPORT_PINNED);
    beam.modes = 12;
    lab_add(lab, "beam", beam);
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.06, 0.001, 0.0), 0.05);
    request.options.horizon = 1.0;
    request.options.tolerance = 1e-6;
    hard_solve(lab, &request, &result);
    const struct solve_contact_result *contact = &result.contacts[0];
    assert_separated(&result);
    assert_in_range(contact->sub_impact_count, 24, 1000);
    assert_true(contact->restitution >= -1.0 && contact->restitution <= 1.0);
    measured("closure", closure_share(&result, 0.0), 0.0, 1e-5);
    /* sub-impacts follow each other and add up */
    double sum = 0.0;
    for (size_t i = 0; i < contact->sub_impacts_listed; i++) {
        sum += contact->sub_impacts[i].impulse;
        assert_true(i == 0 || contact->sub_impacts[i].start >= contact->sub_impacts[i - 1].end);
    }
    if (contact->sub_impacts_listed == contact->sub_impact_count)
        measured_relative("sum", sum, contact->impulse, 1e-12);
    double impulses[2] = {contact->sub_impacts[0].impulse, contact->sub_impacts[1].impulse};
    /* a chaotic sequence either meets its tolerance or says that it does not */
    assert_true(result.tolerance_met || has_warning(&result, "tolerance_met"));
    if (getenv("PERCUSS_MEASURE"))
        print_message("    %zu sub-impacts, e %.9f, met %d\n", contact->sub_impact_count,
                      contact->restitution, result.tolerance_met);
    request.options.method = PERCUSS_METHOD_CVODE;
    request.options.horizon = 0.004;
    hard_solve(lab, &request, &result);
    for (int i = 0; i < 2; i++) /* the reference's tolerance, amplified once */
        measured_relative("sub-impact", impulses[i], result.contacts[0].sub_impacts[i].impulse,
                          i ? 1e-4 : 1e-6);
    lab_free(lab);
}

/* The lowest e over a period of the first mode under an acceleration that lifts. */
static double lowest_restitution(struct lab *lab, struct solve_request *request)
{
    static struct solve_result result;
    double lowest = INFINITY;
    request->contacts[0].gap_acceleration = 200.0;
    request->contacts[0].gap = 1e-5;
    for (int i = 0; i < 40; i++) {
        request->bodies[1].elapsed = 1e-3 + 2.8e-4 * i;
        enum percuss_status status = hard_solve(lab, request, &result);
        if (status == PERCUSS_BAD_REQUEST) { /* overlaps all along: refused by name */
            assert_non_null(strstr(result.fault.text, "contacts[0].gap"));
            continue;
        }
        assert_separated(&result);
        assert_true(result.contacts[0].restitution >= -1.0);
        measured("closure", closure_share(&result, 0.0), 0.0, 1e-5);
        lowest = fmin(lowest, result.contacts[0].restitution);
    }
    return lowest;
}

/* A beam that rings from the last impact can give: e > 1. The rigid gap opens at the end, so that
 * without acceleration e >= 0; a lifting one parts the bodies after a touch that did not stop the
 * approach: e < 0. The energy balances with what the beam had. */
static void bodies_that_ring_already(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    struct body beam = lab->bodies[1];
    beam.modes = 30; /* for the reference's sake */
    lab_add(lab, "beam", beam);
    struct solve_request request = on_beam(0.0, 0.4);
    bool above = false;
    lab_solve(lab, &request, &result);
    size_t size = body_state_size(result.bodies[1].state_after);
    struct body_state *ringing = malloc(size);
    assert_non_null(ringing);
    memcpy(ringing, result.bodies[1].state_after, size);
    double vibration = result.bodies[1].vibration;
    request = on_beam(0.0, 0.05);
    request.bodies[1].state = ringing;
    request.options.tolerance = 1e-6;
    for (int i = 0; i < 40; i++) {
        request.bodies[1].elapsed = 1e-3 + 4.7e-4 * i;
        hard_solve(lab, &request, &result);
        double e = result.contacts[0].restitution;
        double approach = 0.5 * 0.05 * result.contacts[0].impulse_compression;
        assert_separated(&result);
        assert_true(e >= -1e-12);
        /* no body moves but the ball, and nothing is damped: the beam has what it had */
        measured_relative("available", result.energy.available, vibration + approach, 1e-9);
        measured("closure", closure_share(&result, 0.0), 0.0, 1e-5);
        assert_true(result.time_shift != 0.0);
        above = above || e > 1.0;
        if (i % 16)
            continue;
        /* the same start for the reference; its e where the sequence does not amplify */
        double shift = result.time_shift;
        double first = result.contacts[0].sub_impacts[0].impulse;
        request.options.method = PERCUSS_METHOD_CVODE;
        hard_solve(lab, &request, &result);
        request.options.method = PERCUSS_METHOD_MODAL;
        measured("time shift", result.time_shift, shift, 1e-9);
        measured_relative("first", first, result.contacts[0].sub_impacts[0].impulse, 1e-5);
    }
    assert_true(above);
    assert_true(lowest_restitution(lab, &request) < 0.0);
    free(ringing);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_graze_of_1e_12_of_the_first_impulse),
        cmocka_unit_test(the_graze_of_the_paper_s_beam_vanishes),
        cmocka_unit_test(dozens_of_sub_impacts),
        cmocka_unit_test(bodies_that_ring_already),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
