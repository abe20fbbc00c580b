/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Several contacts at once that share a vibrating body: modal against CVODE, energy, momentum. */
#include "physics/support.h"

enum { BALLS = 3, SCENES = 10 };

/* Balls that come down on a beam side by side, each with its own speed and gap. */
static struct solve_request balls_on_beam(struct lab *lab, uint64_t *seed, int balls)
{
    struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    beam.modes = 10;
    beam.damping = random_between(seed, 0.0, 1.0) < 0.5 ? 0.0 : 0.01;
    lab_add(lab, "beam", beam);
    double radius = 0.012;
    struct solve_request request =
        strike(sphere_spot("ball", radius), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
    request.body_count = (size_t)balls + 1;
    request.contact_count = (size_t)balls;
    struct solve_body beam_body = request.bodies[1];
    request.bodies[balls] = beam_body;
    for (int i = 0; i < balls; i++) {
        struct solve_body *ball = &request.bodies[i];
        double x = -0.4 + 0.3 * i + random_between(seed, 0.0, 0.2);
        *ball = request.bodies[0];
        ball->position[0] = x;
        ball->velocity[2] = -random_between(seed, 0.05, 0.4);
        request.contacts[i] = (struct solve_contact){.a = (unsigned)i,
                                                     .b = (unsigned)balls,
                                                     .point = {x, 0.0, 0.0},
                                                     .normal = {0.0, 0.0, 1.0},
                                                     .gap = random_between(seed, -2e-5, 2e-5)};
    }
    request.options.tolerance = 1e-6;
    return request;
}

static void groups_agree_with_cvode(void **state)
{
    (void)state;
    static struct solve_result modal, cvode;
    struct lab *lab = lab_create();
    uint64_t seed = 77;
    lab_add(lab, "ball", make_sphere(STEEL, 0.012));
    for (int i = 0; i < SCENES; i++) {
        int balls = 2 + i % (BALLS - 1);
        struct solve_request request = balls_on_beam(lab, &seed, balls);
        struct solve_workspace *other = solve_workspace_create();
        assert_non_null(other);
        lab_solve(lab, &request, &modal);
        request.options.method = PERCUSS_METHOD_CVODE;
        assert_int_equal(solve(other, &lab->means, &request, &cvode), PERCUSS_OK);
        measured("closure, modal", modal.energy.closure / modal.energy.available, 0.0, 1e-5);
        measured("closure, cvode", cvode.energy.closure / cvode.energy.available, 0.0, 1e-5);
        measured("time shift", modal.time_shift, cvode.time_shift, 1e-9);
        double momentum = 0.0;
        for (int c = 0; c < balls; c++) {
            /* tolerance 1e-6 each, amplified by a sequence */
            measured("e", modal.contacts[c].restitution, cvode.contacts[c].restitution, 1e-4);
            assert_int_equal(modal.contacts[c].sub_impact_count,
                             cvode.contacts[c].sub_impact_count);
            measured("start", modal.contacts[c].sub_impacts[0].start,
                     cvode.contacts[c].sub_impacts[0].start, 1e-7);
            momentum += modal.contacts[c].impulse;
        }
        const struct body *beam = body_set_find(&lab->set, "beam");
        measured("momentum of the beam", beam->mass * modal.bodies[balls].velocity[2], -momentum,
                 1e-14);
        solve_workspace_free(other);
    }
    lab_free(lab);
}

/* Far apart on a long, heavy beam two hits do not feel each other in time: each is the single one.
 */
static void distant_contacts_are_single_ones(void **state)
{
    (void)state;
    static struct solve_result single, both;
    struct lab *lab = lab_create();
    struct body beam = make_bar(&beam_kind, STEEL, 0.03, 6.0);
    beam.modes = 60;
    lab_add(lab, "beam", beam);
    lab_add(lab, "ball", make_sphere(STEEL, 0.012));
    struct solve_request request =
        strike(sphere_spot("ball", 0.012), side_spot("beam", -2.0, 0.03, 0.0), 0.3);
    request.options.tolerance = 1e-6;
    lab_solve(lab, &request, &single);
    double impulse = single.contacts[0].sub_impacts[0].impulse;
    struct solve_request pair = request;
    pair.body_count = 3;
    pair.contact_count = 2;
    pair.bodies[2] = request.bodies[0];
    pair.bodies[2].position[0] += 4.0;
    pair.contacts[1] = request.contacts[0];
    pair.contacts[1].a = 2;
    pair.contacts[1].point[0] += 4.0;
    lab_solve(lab, &pair, &both);
    /* 120 us of contact, waves of at most 5 km/s need 800 us for 4 m; 60 modes blur that a little
     */
    measured_relative("first", both.contacts[0].sub_impacts[0].impulse, impulse, 1e-4);
    measured_relative("second", both.contacts[1].sub_impacts[0].impulse, impulse, 1e-4);
    /* mirror images */
    measured_relative("mirror", both.contacts[1].sub_impacts[0].impulse,
                      both.contacts[0].sub_impacts[0].impulse, 1e-9);
    lab_free(lab);
}

/* The order in which contacts are stated changes nothing but rounding. */
static void the_order_of_contacts_is_free(void **state)
{
    (void)state;
    static struct solve_result first, second;
    struct lab *lab = lab_create();
    uint64_t seed = 5;
    lab_add(lab, "ball", make_sphere(STEEL, 0.012));
    struct solve_request request = balls_on_beam(lab, &seed, 3);
    lab_solve(lab, &request, &first);
    struct solve_request turned = request;
    for (int c = 0; c < 3; c++)
        turned.contacts[c] = request.contacts[(c + 1) % 3];
    double e[3];
    for (int c = 0; c < 3; c++)
        e[c] = first.contacts[(c + 1) % 3].restitution;
    lab_solve(lab, &turned, &second);
    for (int c = 0; c < 3; c++)
        measured("e", second.contacts[c].restitution, e[c], 1e-8);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(groups_agree_with_cvode),
        cmocka_unit_test(distant_contacts_are_single_ones),
        cmocka_unit_test(the_order_of_contacts_is_free),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
