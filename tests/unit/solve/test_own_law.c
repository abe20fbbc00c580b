/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Laws of a catalogue in answers (contact/law_own.c, law_power.c; solve/contact_model.c): closed
 * forms of two rigid balls, and a beam by both methods. */
#include "physics/support.h"

static const struct material OTHER = {"other", 210e9, 0.30, 7850.0, INFINITY, 0.0};
static const double STIFFNESS = 1e6; /* N/m^exponent */

enum { POINTS = 60 };

static struct solve_result result;

/* A ball, another one and a beam of the other material, and their law. */
static struct lab *with_law(struct own_law *law)
{
    struct lab *lab = lab_create();
    strcpy(law->name, "pad");
    strcpy(law->between[0], OTHER.name);
    strcpy(law->between[1], STEEL.name);
    lab->set.laws = law;
    lab->set.law_count = 1;
    lab_add(lab, "ball", make_sphere(STEEL, 0.01));
    lab_add(lab, "pad", make_sphere(OTHER, 0.01));
    lab_add(lab, "beam", make_bar(&beam_kind, OTHER, 0.008, 0.5));
    return lab;
}

static struct solve_request balls(double speed)
{
    struct solve_request request =
        strike(sphere_spot("ball", 0.01), sphere_spot("pad", 0.01), speed);
    request.options.tolerance = 1e-6;
    return request;
}

static double reduced_mass(const struct lab *lab)
{
    double a = lab->bodies[0].mass, b = lab->bodies[1].mass;
    return a * b / (a + b);
}

/* Work of the approach = stiffness D^(n+1)/(n+1), and the time back to the touch 2 D/v int_0^1
 * dx/sqrt(1 - x^(n+1)). */
static void powers_without_loss(void **state)
{
    (void)state;
    static const double integral[] = {M_PI_2, 1.4716374, 1.4021821}; /* of n = 1, 1.5, 2 */
    for (int i = 0; i < 3; i++) {
        double n = 1.0 + 0.5 * i, speed = 0.7;
        struct own_law law = {.stiffness = STIFFNESS, .exponent = n, .deviation = 0.05};
        struct lab *lab = with_law(&law);
        struct solve_request request = balls(speed);
        lab_solve(lab, &request, &result);
        const struct solve_contact_result *contact = &result.contacts[0];
        double depth =
            pow((n + 1.0) * 0.5 * reduced_mass(lab) * speed * speed / STIFFNESS, 1.0 / (n + 1.0));
        near(contact->restitution, 1.0, 1e-9);
        near_relative(contact->sub_impacts[0].max_indentation, depth, 1e-6);
        near_relative(contact->end_time - contact->sub_impacts[0].start,
                      2.0 * depth / speed * integral[i], 1e-5);
        assert_int_equal(result.contact_model, PERCUSS_CONTACT_LAW);
        lab_free(lab);
    }
}

/* 1 - e^2 is the share that is lost, at each speed; by both methods. */
static void hysteresis(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        double lost = 0.15 + 0.2 * (i % 4);
        struct own_law law = {.stiffness = STIFFNESS,
                              .exponent = i % 2 ? 1.0 : 1.5,
                              .hysteresis = lost,
                              .deviation = 0.05};
        struct lab *lab = with_law(&law);
        struct solve_request request = balls(i < 4 ? 0.1 : 5.0);
        request.options.method = i % 3 ? PERCUSS_METHOD_MODAL : PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &result);
        near(result.contacts[0].restitution, sqrt(1.0 - lost), 1e-6);
        near_relative(result.energy.plastic, lost * result.energy.available, 1e-6);
        lab_free(lab);
    }
}

/* e of Hunt and Crossley's law: c v (1 + e) = ln((1 + c v)/(1 - c v e)), whatever exponent and mass
 * (their paper's first integral). */
static void dissipation(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        double speed = 0.3 + i, c = 0.4;
        struct own_law law = {.stiffness = STIFFNESS,
                              .exponent = i % 2 ? 2.0 : 1.5,
                              .dissipation = c,
                              .deviation = 0.05};
        struct lab *lab = with_law(&law);
        struct solve_request request = balls(speed);
        if (i >= 2) { /* it slides throughout, which leaves the normal motion as it is */
            request.contacts[0].friction = 0.2;
            request.options.friction = PERCUSS_FRICTION_PLAIN;
            request.bodies[0].velocity[0] = 10.0 * speed;
        }
        lab_solve(lab, &request, &result);
        const struct solve_contact_result *contact = &result.contacts[0];
        double e = contact->restitution;
        near(c * speed * (1.0 + e), log((1.0 + c * speed) / (1.0 - c * speed * e)), 1e-6);
        near(result.energy.closure, 0.0, 1e-7 * result.energy.available);
        near_relative(1.0 + hypot(contact->impulse_tangential[0], contact->impulse_tangential[1]),
                      1.0 + (i >= 2 ? 0.2 : 0.0) * contact->impulse, 1e-12);
        lab_free(lab);
    }
}

/* Three balls in a row, of which the first comes: the law is between two of them, Hertz's between
 * the others, or of both contacts; by both methods. */
static void dissipation_in_a_row(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        static const char *const ids[2][3] = {{"ball", "pad", "pad"}, {"pad", "ball", "pad"}};
        struct own_law law = {
            .stiffness = 1e9, .exponent = 1.5, .dissipation = 0.4, .deviation = 0.05};
        struct lab *lab = with_law(&law);
        struct solve_request request = {.body_count = 3, .contact_count = 2};
        double impulse[2];
        for (unsigned b = 0; b < 3; b++) {
            strcpy(request.bodies[b].id, ids[i][b]);
            request.bodies[b].position[0] = 0.02 * b;
            request.bodies[b].orientation[0] = 1.0;
        }
        for (unsigned c = 0; c < 2; c++)
            request.contacts[c] = (struct solve_contact){
                .a = c, .b = c + 1, .point = {0.02 * c + 0.01}, .normal = {-1.0, 0.0, 0.0}};
        request.bodies[0].velocity[0] = 0.8;
        request.options.tolerance = 1e-6;
        lab_solve(lab, &request, &result);
        for (int c = 0; c < 2; c++)
            impulse[c] = result.contacts[c].impulse;
        assert_true(result.energy.damping > 0.05 * result.energy.available);
        assert_true(result.restitution_model > 0.0);
        near(result.energy.closure, 0.0, 1e-6 * result.energy.available);
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &result);
        for (int c = 0; c < 2; c++)
            near_relative(result.contacts[c].impulse, impulse[c], 2e-6);
        lab_free(lab);
    }
}

static bool warned(const char *words)
{
    for (size_t i = 0; i < result.warning_count; i++)
        if (strstr(result.warnings[i], words))
            return true;
    return false;
}

/* Beside a contact with a law another one yields, as it would without, and is not told that Hertz's
 * law leaves no dent. */
static void beside_one_that_yields(void **state)
{
    (void)state;
    static const struct material soft = {"soft", 210e9, 0.30, 7850.0, 200e6, 0.0};
    static const char *const ids[] = {"pad", "ball", "soft"};
    struct own_law law = {.stiffness = 1e9, .exponent = 1.5, .dissipation = 0.1, .deviation = 0.05};
    struct lab *lab = with_law(&law);
    lab_add(lab, "soft", make_sphere(soft, 0.01));
    struct solve_request request = {.body_count = 3, .contact_count = 2};
    for (unsigned b = 0; b < 3; b++) {
        strcpy(request.bodies[b].id, ids[b]);
        request.bodies[b].position[0] = 0.02 * b;
        request.bodies[b].orientation[0] = 1.0;
    }
    for (unsigned c = 0; c < 2; c++)
        request.contacts[c] = (struct solve_contact){
            .a = c, .b = c + 1, .point = {0.02 * c + 0.01}, .normal = {-1.0, 0.0, 0.0}};
    request.bodies[0].velocity[0] = 1.0;
    lab_solve(lab, &request, &result);
    assert_int_equal(result.contact_model, PERCUSS_CONTACT_LAW);
    assert_true(result.energy.plastic > 0.2 * result.energy.available);
    assert_false(warned("leaves no dent"));
    lab_free(lab);
}

/* Hertz's law as points is Hertz's law; an unloading curve gives back its own area, also from other
 * indentations than the last one. */
static void by_points(void **state)
{
    (void)state;
    double numbers[2][2 * (POINTS + 1)], stays = 0.3, last = 2e-3;
    double most = STIFFNESS * last * sqrt(last);
    struct own_law law = {.exponent = 1.5,
                          .deviation = 0.05,
                          .points = {.count = POINTS + 1,
                                     .indentation = numbers[0],
                                     .force = numbers[0] + POINTS + 1}};
    for (int i = 0; i <= POINTS; i++) {
        double x = (double)i / POINTS;
        numbers[0][i] = x * last;
        numbers[0][POINTS + 1 + i] = most * x * sqrt(x);
        numbers[1][i] = last * (stays + (1.0 - stays) * x);
        numbers[1][POINTS + 1 + i] = most * x * x;
    }
    for (int i = 0; i < 4; i++) {
        double speed = i % 2 ? 0.3 : 1.2;
        struct own_law own = law;
        if (i >= 2)
            own.unloading = (struct own_curve){
                .count = POINTS + 1, .indentation = numbers[1], .force = numbers[1] + POINTS + 1};
        struct lab *lab = with_law(&own);
        struct solve_request request = balls(speed);
        lab_solve(lab, &request, &result);
        double work = 0.5 * reduced_mass(lab) * speed * speed;
        double depth = pow(2.5 * work / STIFFNESS, 0.4);
        /* int F of unloading: F_max (1 - stays) D/3, of loading 2/5 F_max D; the cubic through 61
         * points of x^(4/3) leaves 1e-5 */
        double e = i < 2 ? 1.0 : sqrt(2.5 * (1.0 - stays) / 3.0);
        near(result.contacts[0].restitution, e, 1e-5);
        near_relative(result.contacts[0].sub_impacts[0].max_indentation, depth, 1e-5);
        assert_false(warned("the points of the law"));
        lab_free(lab);
    }
}

static void beyond_the_points(void **state)
{
    (void)state;
    double numbers[] = {0.0, 1e-4, 2e-4, 0.0, 1.0, 2.83};
    struct own_law law = {.exponent = 1.5,
                          .deviation = 0.05,
                          .points = {.count = 3, .indentation = numbers, .force = numbers + 3}};
    struct lab *lab = with_law(&law);
    struct solve_request request = balls(1.0);
    lab_solve(lab, &request, &result);
    assert_true(warned("the points of the law pad end before the largest indentation"));
    lab_free(lab);
}

/* A beam that rings, by the modal method and by CVODE; the law's deviation is in the bar. */
static void on_a_beam(void **state)
{
    (void)state;
    static struct solve_result other;
    double bars[2];
    for (int i = 0; i < 3; i++) {
        struct own_law law = {
            .stiffness = 1e8, .exponent = 1.5, .hysteresis = 0.3, .deviation = i == 2 ? 0.2 : 0.05};
        struct lab *lab = with_law(&law);
        struct solve_request request =
            strike(sphere_spot("ball", 0.01), side_spot("beam", 0.0, 0.008, 0.0), 0.5);
        request.options.tolerance = 1e-4;
        request.options.method = i == 1 ? PERCUSS_METHOD_CVODE : PERCUSS_METHOD_MODAL;
        lab_solve(lab, &request, i == 1 ? &other : &result);
        if (i != 1)
            bars[i / 2] = result.restitution_model;
        else
            near(other.contacts[0].restitution, result.contacts[0].restitution, 1e-4);
        lab_free(lab);
    }
    assert_true(bars[1] > 2.0 * bars[0]);
}

static void refused(struct lab *lab, const struct solve_request *request, const char *words)
{
    solve(lab->workspace, &lab->means, request, &result);
    assert_int_equal(result.status, PERCUSS_BAD_REQUEST);
    if (!strstr(result.fault.text, words))
        fail_msg("%s", result.fault.text);
}

static void asked_for(void **state)
{
    (void)state;
    struct own_law law = {.stiffness = STIFFNESS, .exponent = 1.0, .dissipation = 0.1};
    struct lab *lab = with_law(&law);
    struct solve_request request = balls(1.0);
    request.contacts[0].friction = 0.2;
    request.bodies[0].velocity[0] = 1.0;
    refused(lab, &request, "contacts[0]: the law pad has exponent 1: with micro-slip");
    law.dissipation = 0.0;
    refused(lab, &request, "contacts[0]: the law pad has exponent 1: with micro-slip");
    law.exponent = 1.5;
    law.dissipation = 0.1;
    request.options.method = PERCUSS_METHOD_CVODE;
    refused(lab, &request,
            "contacts[0]: the law pad, which has a dissipation: method cvode has no friction");
    /* another model takes no law of the catalogue; that law needs one */
    request = balls(1.0);
    request.options.contact_model = PERCUSS_CONTACT_HERTZ;
    lab_solve(lab, &request, &result);
    assert_int_equal(result.contact_model, PERCUSS_CONTACT_HERTZ);
    request.options.contact_model = PERCUSS_CONTACT_LAW;
    lab_solve(lab, &request, &result);
    assert_int_equal(result.contact_model, PERCUSS_CONTACT_LAW);
    lab->set.law_count = 0;
    refused(lab, &request,
            "options.contact_model: law: the catalogue has no law between steel and other");
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_without_loss),
        cmocka_unit_test(hysteresis),
        cmocka_unit_test(dissipation),
        cmocka_unit_test(dissipation_in_a_row),
        cmocka_unit_test(beside_one_that_yields),
        cmocka_unit_test(by_points),
        cmocka_unit_test(beyond_the_points),
        cmocka_unit_test(on_a_beam),
        cmocka_unit_test(asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
