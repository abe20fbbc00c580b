/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The energy audit of physics notes, section 4: every term by itself, |closure| at most 1e-9 of
 * what was available at a tolerance of 1e-8 or less, ten times the tolerance or 1e-2 otherwise. */
#include "physics/support.h"

static const double dampings[] = {0.0, 1e-5, 1e-3, 0.02, 0.2, 0.7, 0.97};

enum { SCENES = 6 };

/* modes: a fixed number keeps strongly damped scenes cheap; 0: by the tolerance. */
static struct lab *lab_with_damping(double damping, unsigned modes)
{
    struct lab *lab = lab_create();
    struct body rod = make_bar(&rod_kind, ALUMINIUM, 0.010, 0.6);
    struct body tipped = make_bar(&rod_kind, STEEL, 0.008, 0.3);
    struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    struct body flat = make_supported(make_body(&beam_kind, STEEL), SUPPORT_PINNED, SUPPORT_FREE);
    tipped.tip_radius = 0.012;
    flat.width = 0.02;
    flat.height = 0.008;
    flat.length = 0.4;
    rod.damping = tipped.damping = beam.damping = flat.damping = damping;
    rod.modes = tipped.modes = beam.modes = flat.modes = modes;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "rod", rod);
    lab_add(lab, "tipped", tipped);
    lab_add(lab, "beam", beam);
    lab_add(lab, "flat", flat);
    return lab;
}

static struct solve_request scene(int index)
{
    const struct spot ball = sphere_spot("ball", 0.015);
    const struct spot flat = {"flat", {0.1, 0.002, 0.004}, {0.0, 0.0, 1.0}, 0.0};
    switch (index) {
    case 0:
        return strike(ball, end_spot("rod", 0.6), 0.3);
    case 1:
        return strike(ball, side_spot("beam", 0.1, 0.010, 0.5), 0.2);
    case 2:
        return strike(end_spot("tipped", 0.3), end_spot("rod", 0.6), 0.4);
    case 3:
        return strike(end_spot("tipped", 0.3), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
    case 4:
        return strike(ball, flat, 0.3);
    default:
        return strike(ball, end_spot("beam", 1.0), 0.3);
    }
}

static double share(const struct solve_result *result)
{
    return result->energy.closure / result->energy.available;
}

static void check_terms(const struct solve_result *result, bool damped)
{
    const struct impact_energy *energy = &result->energy;
    double vibration = 0.0;
    for (size_t b = 0; b < result->body_count; b++)
        vibration += result->bodies[b].vibration;
    measured_relative("vibration by body", vibration, energy->vibration, 1e-12);
    assert_true(energy->plastic == 0.0);
    assert_true(energy->rigid_after >= 0.0 && energy->vibration >= 0.0);
    assert_true(damped ? energy->damping > 0.0 : energy->damping == 0.0);
    double sum = energy->rigid_after + energy->vibration + energy->damping + energy->plastic +
                 energy->stored;
    measured("closure is the difference", energy->available - sum, energy->closure,
             1e-14 * energy->available);
}

static void close_all(double damping, unsigned modes)
{
    static struct solve_result result;
    static const double tolerances[] = {1e-3, 1e-6, 1e-8};
    struct lab *lab = lab_with_damping(damping, modes);
    for (int i = 0; i < SCENES; i++) {
        for (size_t t = 0; t < COUNT(tolerances); t++) {
            struct solve_request request = scene(i);
            char what[96];
            request.options.tolerance = tolerances[t];
            lab_solve(lab, &request, &result);
            snprintf(what, sizeof what, "closure, scene %d, damping %g, tolerance %g", i, damping,
                     tolerances[t]);
            /* the notes' bounds */
            measured(what, share(&result), 0.0, t < 2 ? 10.0 * tolerances[t] : 1e-9);
            assert_true(result.energy.stored == 0.0);
            check_terms(&result, damping > 0.0);
        }
    }
    lab_free(lab);
}

static void every_damping_closes(void **state)
{
    (void)state;
    for (size_t d = 0; d < COUNT(dampings); d++)
        close_all(dampings[d], 24);
}

static void every_number_of_modes_closes(void **state)
{
    (void)state;
    close_all(0.0, 0);
}

/* Forces that the rigid motion feels all the time: their work is part of what is available. */
static void acceleration_and_gaps_close(void **state)
{
    (void)state;
    static struct solve_result result;
    static const double accelerations[] = {-30.0, -9.81, 9.81, 30.0};
    static const double gaps[] = {-2e-4, 0.0, 1e-4};
    for (size_t d = 0; d < 4; d += 3) {
        struct lab *lab = lab_with_damping(dampings[d], 24);
        for (int i = 0; i < SCENES; i++) {
            for (size_t k = 0; k < COUNT(accelerations) * COUNT(gaps); k++) {
                struct solve_request request = scene(i);
                request.contacts[0].gap_acceleration = accelerations[k / COUNT(gaps)];
                request.contacts[0].gap = gaps[k % COUNT(gaps)];
                request.options.tolerance = 1e-8;
                enum percuss_status status = solve(lab->workspace, &lab->means, &request, &result);
                /* a pressed body may rattle beyond the horizon */
                assert_true(status == PERCUSS_OK || status == PERCUSS_TRUNCATED);
                /* what is available shrinks as a pulling acceleration spends it: compare with the
                 * approach's energy at least */
                double v = request.bodies[0].velocity[2];
                double w = result.contacts[0].inverse_effective_mass;
                double scale = fmax(result.energy.available, 0.5 * v * v / w);
                measured("closure, acceleration", result.energy.closure / scale, 0.0, 1e-9);
            }
        }
        lab_free(lab);
    }
}

/* A horizon inside the contact: the law and the residual flexibility hold energy then. */
static void an_unfinished_contact_stores_energy(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_with_damping(0.02, 24);
    for (int i = 0; i < SCENES; i++) {
        for (double horizon = 2e-5; horizon < 9e-5; horizon += 3e-5) {
            struct solve_request request = scene(i);
            request.options.tolerance = 1e-8;
            request.options.horizon = horizon;
            assert_int_equal(solve(lab->workspace, &lab->means, &request, &result),
                             PERCUSS_TRUNCATED);
            assert_int_equal(result.end_reason, PERCUSS_END_IN_CONTACT);
            assert_true(result.energy.stored > 0.0);
            measured("closure, in contact", share(&result), 0.0, 1e-9);
            check_terms(&result, true);
        }
    }
    lab_free(lab);
}

/* The weight does far more work on the way in and out than the approach brings: whatever the
 * tolerance, the steps are made so short that 1 % of what is available remains at most. */
static void a_ball_laid_down_keeps_its_energy(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(ALUMINIUM, 0.020));
    lab_add(lab, "wall", make_body(&half_space_kind, STEEL));
    for (double speed = 3e-5; speed < 1e-3; speed *= 1.7) {
        for (double tolerance = 1e-3; tolerance <= 1e-2; tolerance *= 1.5) {
            struct solve_request request =
                strike(sphere_spot("ball", 0.020), wall_spot("wall"), speed);
            request.contacts[0].gap_acceleration = -9.81;
            request.options.tolerance = tolerance;
            lab_solve(lab, &request, &result);
            measured("closure, laid down", share(&result), 0.0, 0.01);
        }
    }
    lab_free(lab);
}

enum { DRIVEN = 60 };

/* Balls on a body whose W, the client's, yields to one motion of theirs only: they approach by
 * others too, which no force changes and whose work is in what is available. */
static void driven_contacts_close_theirs(void **state)
{
    (void)state;
    static struct solve_result result;
    uint64_t seed = 41;
    size_t solved = 0;
    for (int i = 0; i < DRIVEN; i++) {
        size_t n = 2 + (size_t)(i % 2);
        struct lab *lab = lab_with_damping(i % 4 < 2 ? 0.0 : 0.01, 12);
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
        double w[9], along[3];
        request.body_count = n + 1;
        request.contact_count = n;
        request.bodies[n] = request.bodies[1];
        request.delassus = w;
        request.options.tolerance = 1e-3;
        request.options.method = i % 8 < 6 ? PERCUSS_METHOD_MODAL : PERCUSS_METHOD_CVODE;
        struct solve_body ball = request.bodies[0];
        for (size_t c = 0; c < n; c++) {
            double x = 0.2 * (double)c - 0.3;
            along[c] = random_between(&seed, 0.5, 4.0);
            request.bodies[c] = ball;
            request.bodies[c].position[0] = x;
            request.bodies[c].velocity[2] = -random_between(&seed, 0.01, 1.0);
            request.contacts[c] = (struct solve_contact){
                .a = (unsigned)c, .b = (unsigned)n, .point = {x, 0.0, 0.0}, .normal = {0, 0, 1}};
            request.contacts[c].gap_acceleration = random_between(&seed, -300.0, 900.0);
            request.contacts[c].gap = random_between(&seed, 0.0, 1e-6);
        }
        for (size_t k = 0; k < n * n; k++)
            w[k] = along[k / n] * along[k % n];
        enum percuss_status status = solve(lab->workspace, &lab->means, &request, &result);
        assert_true(status == PERCUSS_OK || status == PERCUSS_TRUNCATED);
        if (result.end_reason != PERCUSS_END_LIMIT)
            measured("closure", share(&result), 0.0, 1e-5);
        solved += result.end_reason != PERCUSS_END_LIMIT;
        lab_free(lab);
    }
    assert_true(solved > DRIVEN / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_damping_closes),
        cmocka_unit_test(every_number_of_modes_closes),
        cmocka_unit_test(acceleration_and_gaps_close),
        cmocka_unit_test(an_unfinished_contact_stores_energy),
        cmocka_unit_test(a_ball_laid_down_keeps_its_energy),
        cmocka_unit_test(driven_contacts_close_theirs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
