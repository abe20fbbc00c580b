/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Rigid bodies with Hertz contacts against closed forms (physics notes, section 5): duration, force
 * and indentation, a restitution of one for every W, and the chain of three spheres. */
#include "physics/support.h"

/* Hertz's collision of the effective mass m at speed v: largest indentation, force and duration
 * (Johnson, Contact Mechanics, section 11.4; 4 sqrt(pi) Gamma(2/5)/(5 Gamma(9/10)) = 2.943...). */
static void closed_form(double m, double k, double v, double values[3])
{
    double d = pow(1.25 * m * v * v / k, 0.4);
    values[0] = d;
    values[1] = k * d * sqrt(d);
    values[2] = 0.8 * sqrt(M_PI) * tgamma(0.4) / tgamma(0.9) * d / v;
}

static void check_hertz(struct lab *lab, struct solve_request *request, double m, double k,
                        double v)
{
    static struct solve_result result;
    double expected[3];
    request->options.tolerance = 1e-10;
    lab_solve(lab, request, &result);
    const struct solve_contact_result *contact = &result.contacts[0];
    const struct sub_impact *sub = contact->sub_impacts;
    closed_form(m, k, v, expected);
    assert_int_equal(contact->sub_impact_count, 1);
    assert_int_equal(result.end_reason, PERCUSS_END_SEPARATED);
    /* tolerance 1e-10 on e; 1e-9 as the notes ask */
    measured("e", contact->restitution, 1.0, 1e-9);
    measured_relative("impulse", contact->impulse, 2.0 * m * v, 1e-9);
    /* half the impulse by symmetry, but the instant of the peak is found on a cubic */
    measured_relative("compression impulse", sub->compression_impulse, m * v, 1e-5);
    /* the peak lies on a cubic through four nodes of the step: its fourth-order error */
    measured_relative("indentation", sub->max_indentation, expected[0], 1e-5);
    measured_relative("force", sub->peak_force, expected[1], 1e-5);
    /* the release is placed by a straight line within the last, shortest step */
    measured_relative("duration", sub->end - sub->start, expected[2], 1e-7);
    measured_relative("gap rate after", sub->gap_rate_after, v, 1e-9);
}

static void glass_spheres_meet_as_hertz_says(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    const struct body *glass = lab_add(lab, "glass", make_sphere(GLASS, 0.010));
    struct solve_request request =
        strike(sphere_spot("glass", 0.010), sphere_spot("glass", 0.010), 10.0);
    request.bodies[1].velocity[2] = 10.0;
    double k = sphere_plane_stiffness(GLASS, GLASS, 0.005); /* 1/R = 1/R1 + 1/R2 */
    check_hertz(lab, &request, 0.5 * glass->mass, k, 20.0);
    static struct solve_result result;
    lab_solve(lab, &request, &result);
    const struct sub_impact *sub = result.contacts[0].sub_impacts;
    /* the notes' digits, half a unit of the last one */
    measured("duration", 1e6 * (sub->end - sub->start), 40.34, 0.005);
    measured("force", sub->peak_force, 10696.9, 0.05);
    measured("indentation", 1e6 * sub->max_indentation, 274.11, 0.005);
    lab_free(lab);
}

static void a_sphere_rebounds_from_a_rigid_wall(void **state)
{
    (void)state;
    struct material metal = {"metal", 70e9, 0.30, 2699.0, INFINITY, 0.0};
    struct lab *lab = lab_create();
    const struct body *ball = lab_add(lab, "ball", make_sphere(metal, 0.1));
    lab_add(lab, "wall", rigid_wall());
    struct solve_request request = strike(sphere_spot("ball", 0.1), wall_spot("wall"), 0.2);
    double k = 4.0 / 3.0 * 70e9 / (1.0 - 0.09) * sqrt(0.1);
    check_hertz(lab, &request, ball->mass, k, 0.2);
    static struct solve_result result;
    lab_solve(lab, &request, &result);
    const struct sub_impact *sub = result.contacts[0].sub_impacts;
    measured("duration", 1e6 * (sub->end - sub->start), 731.66, 0.005);
    measured("force", sub->peak_force, 11369.9, 0.05);
    measured("indentation", 1e6 * sub->max_indentation, 49.717, 0.0005);
    lab_free(lab);
}

/* Bodies without vibration on each other, off centre too, so that they spin: e stays one. */
static void compact_bodies_return_everything(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    struct body block = make_body(&block_kind, ALUMINIUM);
    memcpy(block.size, (double[]){0.05, 0.08, 0.03}, sizeof block.size);
    block.rigid = true;
    lab_add(lab, "block", block);
    lab_add(lab, "ball", make_sphere(STEEL, 0.012));
    struct body drum = make_bar(&cylinder_kind, STEEL, 0.02, 0.05);
    drum.rigid = true;
    lab_add(lab, "drum", drum);
    const struct spot ball = sphere_spot("ball", 0.012);
    const struct spot block_off_centre = {"block", {0.01, -0.02, 0.015}, {0.0, 0.0, 1.0}, 0.3};
    const struct spot drum_side = side_spot("drum", 0.01, 0.02, 0.7);
    struct spot drum_across = drum_side;
    drum_across.roll = 1.2;
    struct solve_request requests[] = {
        strike(ball, block_off_centre, 0.5), strike(ball, drum_side, 0.5),
        strike(drum_side, drum_across, 0.5), /* crossed cylinders */
    };
    for (size_t i = 0; i < COUNT(requests); i++) {
        requests[i].options.tolerance = 1e-12;
        lab_solve(lab, &requests[i], &result);
        assert_int_equal(result.contacts[0].sub_impact_count, 1);
        /* tolerance 1e-12 on e, and some 1000 roundings of 1e-16 on the way */
        measured("e", result.contacts[0].restitution, 1.0, 1e-11);
        assert_true(result.bodies[0].rigid && result.bodies[1].rigid);
    }
    lab_free(lab);
}

static void the_clients_w_rules_the_dynamics(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.012));
    lab_add(lab, "wall", rigid_wall());
    uint64_t seed = 11;
    for (int i = 0; i < 12; i++) {
        double w = pow(10.0, random_between(&seed, -4.0, 5.0));
        struct solve_request request = strike(
            sphere_spot("ball", 0.012), i % 2 ? wall_spot("wall") : sphere_spot("ball", 0.012),
            random_between(&seed, 0.01, 3.0));
        request.delassus = &w;
        request.options.tolerance = 1e-12;
        request.options.horizon = 1.0; /* heavy pairs meet for long */
        lab_solve(lab, &request, &result);
        /* the notes ask for 1e-12 */
        measured("e", result.contacts[0].restitution, 1.0, 1e-12);
        measured_relative("inverse mass", result.contacts[0].inverse_effective_mass, w, 0.0);
        assert_int_equal(result.delassus_source, PERCUSS_DELASSUS_CLIENT);
        assert_false(result.velocities_known);
    }
    lab_free(lab);
}

/* Three equal spheres in line, the first at v = 1: both contacts in one group. */
static void check_chain(enum percuss_method method, double tolerance)
{
    static const double after[3] = {-0.070952, 0.076403, 0.994549};
    static struct solve_result result;
    struct lab *lab = lab_create();
    const struct body *ball = lab_add(lab, "ball", make_sphere(STEEL, 0.01));
    struct solve_request request = {.body_count = 3, .contact_count = 2};
    double momentum = 0.0;
    for (int i = 0; i < 3; i++) {
        struct solve_body *body = &request.bodies[i];
        snprintf(body->id, sizeof body->id, "ball");
        body->position[0] = 0.02 * i;
        body->orientation[0] = 1.0;
    }
    request.bodies[0].velocity[0] = 1.0;
    request.contacts[0] = (struct solve_contact){
        .a = 0, .b = 1, .point = {0.01, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}};
    request.contacts[1] = (struct solve_contact){
        .a = 1, .b = 2, .point = {0.03, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}};
    request.options.tolerance = tolerance;
    request.options.method = method;
    lab_solve(lab, &request, &result);
    for (int i = 0; i < 3; i++) {
        /* the notes' digits, and the tolerance on e */
        measured("velocity", result.bodies[i].velocity[0], after[i], 5e-7 + tolerance);
        momentum += result.bodies[i].velocity[0];
    }
    /* the impulses act on two spheres each: rounding only */
    measured("momentum", momentum, 1.0, 1e-14);
    double closure_allowed = tolerance > 1e-8 ? 10.0 * tolerance : 1e-9;
    measured("closure", result.energy.closure / result.energy.available, 0.0, closure_allowed);
    /* all kinetic energy but that of the common motion at v/3 */
    measured_relative("available", result.energy.available, ball->mass / 3.0, 1e-12);
    /* the complementarity problem of Eq. (4): all three go on at v/3; lcp.h raises the diagonal by
     * 1e-10 of itself */
    measured_relative("compression", result.contacts[0].impulse_compression, 2.0 / 3.0 * ball->mass,
                      1e-9);
    measured_relative("compression", result.contacts[1].impulse_compression, ball->mass / 3.0,
                      1e-9);
    lab_free(lab);
}

static void a_chain_of_three_spheres_by_modal(void **state)
{
    (void)state;
    check_chain(PERCUSS_METHOD_MODAL, 1e-6);
}

static void a_chain_of_three_spheres_tightly(void **state)
{
    (void)state;
    check_chain(PERCUSS_METHOD_MODAL, 1e-8);
}

static void a_chain_of_three_spheres_by_cvode(void **state)
{
    (void)state;
    check_chain(PERCUSS_METHOD_CVODE, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glass_spheres_meet_as_hertz_says),
        cmocka_unit_test(a_sphere_rebounds_from_a_rigid_wall),
        cmocka_unit_test(compact_bodies_return_everything),
        cmocka_unit_test(the_clients_w_rules_the_dynamics),
        cmocka_unit_test(a_chain_of_three_spheres_by_modal),
        cmocka_unit_test(a_chain_of_three_spheres_tightly),
        cmocka_unit_test(a_chain_of_three_spheres_by_cvode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
