/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Columns of spheres that touch at rest, hit at the top: groups whose contacts open and close with
 * next to no force. Against CVODE, energy and momentum. */
#include "physics/support.h"

static struct solve_request column(struct lab *lab, int count, double tolerance)
{
    static const double radii[] = {0.005, 0.009, 0.017, 0.008, 0.010};
    struct material steel = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};
    struct solve_request request = {.body_count = (size_t)count,
                                    .contact_count = (size_t)count - 1};
    double z = 0.0;
    for (int i = 0; i < count; i++) {
        struct solve_body *body = &request.bodies[i];
        snprintf(body->id, sizeof body->id, "s%d", i);
        lab_add(lab, body->id, make_sphere(steel, radii[i]));
        z -= i ? radii[i - 1] + radii[i] : 0.0;
        body->orientation[0] = 1.0;
        body->position[2] = z;
        if (i == 0)
            continue;
        struct solve_contact *contact = &request.contacts[i - 1];
        contact->a = (unsigned)i - 1;
        contact->b = (unsigned)i;
        contact->normal[2] = 1.0;
        contact->point[2] = z + radii[i];
    }
    request.bodies[0].velocity[2] = -1.0;
    request.options.tolerance = tolerance;
    return request;
}

static void columns_agree_with_cvode(void **state)
{
    (void)state;
    static struct solve_result modal;
    static struct solve_result cvode;
    for (int count = 3; count <= 5; count++) {
        struct lab *lab = lab_create();
        struct solve_request request = column(lab, count, 1e-6);
        lab_solve(lab, &request, &modal);
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &cvode);
        assert_int_equal(modal.end_reason, PERCUSS_END_SEPARATED);
        /* ten times the tolerance, as the notes have it */
        measured("closure", modal.energy.closure / modal.energy.available, 0.0, 1e-5);
        double momentum = 0.0;
        for (int i = 0; i < count; i++) {
            /* either method within its tolerance of 1e-6, against speeds of 1 m/s */
            measured("velocity", modal.bodies[i].velocity[2], cvode.bodies[i].velocity[2], 1e-5);
            momentum += lab->set.bodies[i].mass * modal.bodies[i].velocity[2];
        }
        measured("momentum", momentum, -lab->set.bodies[0].mass, 1e-12 * lab->set.bodies[0].mass);
        lab_free(lab);
    }
}

/* Ten unlike spheres, gaps between some, hit from one end: contacts with a small compression
 * impulse of their own pass on large ones, and open and close. The estimate was that of one
 * contact: e of the fourth to sixth was wrong by hundreds of it. The reference is CVODE's. */
static void long_columns_say_how_wrong_they_are(void **state)
{
    (void)state;
    static struct solve_result answer, cvode;
    static const double radii[] = {4.5e-3, 7.0e-3, 3.1e-3, 8.2e-3, 2.4e-3,
                                   5.6e-3, 2.7e-3, 6.4e-3, 3.9e-3, 8.8e-3};
    static const double gaps[] = {0.0, 3e-7, 0.0, 2e-6, 0.0, 1e-8, 0.0, 0.0, 5e-6};
    static const double tolerances[] = {1e-8, 1e-2, 1e-3, 1e-4};
    struct lab *lab = lab_create();
    struct solve_request request = {.body_count = COUNT(radii), .contact_count = COUNT(gaps)};
    double z = 0.0;
    for (unsigned i = 0; i < COUNT(radii); i++) {
        struct solve_body *body = &request.bodies[i];
        snprintf(body->id, sizeof body->id, "s%u", i);
        lab_add(lab, body->id, make_sphere(STEEL, radii[i]));
        body->orientation[0] = 1.0;
        body->position[2] = z - radii[i];
        z -= 2.0 * radii[i];
        if (i == COUNT(gaps))
            break;
        request.contacts[i] = (struct solve_contact){
            .a = i, .b = i + 1, .normal = {0.0, 0.0, 1.0}, .point = {0.0, 0.0, z}, .gap = gaps[i]};
        z -= gaps[i];
    }
    request.bodies[0].velocity[2] = -0.1;
    for (size_t t = 0; t < COUNT(tolerances); t++) {
        request.options.tolerance = tolerances[t];
        request.options.method = t == 0 ? PERCUSS_METHOD_CVODE : PERCUSS_METHOD_MODAL;
        lab_solve(lab, &request, t == 0 ? &cvode : &answer);
        double reported = answer.restitution_time + answer.restitution_modes;
        for (size_t c = 0; t > 0 && c < COUNT(gaps); c++) {
            double e = cvode.contacts[c].restitution;
            measured("e, within what it says", answer.contacts[c].restitution, e, reported);
            if (answer.tolerance_met)
                measured("e", answer.contacts[c].restitution, e, tolerances[t]);
        }
    }
    lab_free(lab);
}

/* A stiff bead on a heavy ball that swings for milliseconds on a soft one: its blows of a tenth of
 * a millisecond begin anywhere within the long steps of the others, also behind their last node.
 * Such a blow was wrong by a thousandth at every accuracy down to 1e-10. */
static void short_blows_within_long_contacts(void **state)
{
    (void)state;
    static struct solve_result answer, cvode;
    const struct material rubber = {"rubber", 5e6, 0.49, 1100.0, INFINITY, 0.0};
    const struct material lead = {"lead", 16e9, 0.44, 11340.0, INFINITY, 0.0};
    const struct material carbide = {"carbide", 600e9, 0.22, 15600.0, INFINITY, 0.0};
    const struct material materials[] = {STEEL, lead, rubber, carbide, GLASS};
    static const double radii[] = {9.328e-3, 12.061e-3, 7.283e-3, 17.443e-3, 8.156e-3};
    enum { BALLS = COUNT(radii), PLACES = 16 };
    struct lab *lab = lab_create();
    struct solve_request request = {.body_count = BALLS, .contact_count = BALLS - 1};
    for (int place = 0; place < PLACES; place++) {
        double z = 0.0;
        for (unsigned i = 0; i < BALLS; i++) {
            struct solve_body *body = &request.bodies[i];
            snprintf(body->id, sizeof body->id, "s%u", i);
            lab_add(lab, body->id, make_sphere(materials[i], radii[i]));
            body->orientation[0] = 1.0;
            body->position[2] = z - radii[i];
            z -= 2.0 * radii[i];
            if (i + 1 == BALLS)
                break;
            double gap = i + 2 == BALLS ? 5.9e-6 + 2e-8 * place : 0.0;
            request.contacts[i] = (struct solve_contact){
                .a = i, .b = i + 1, .normal = {0.0, 0.0, 1.0}, .point = {0.0, 0.0, z}, .gap = gap};
            z -= gap;
        }
        request.bodies[0].velocity[2] = -1.332;
        request.options.tolerance = 1e-3;
        request.options.method = PERCUSS_METHOD_MODAL;
        lab_solve(lab, &request, &answer);
        request.options.tolerance = 1e-7;
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &cvode);
        double reported = answer.restitution_time + answer.restitution_modes;
        for (int c = 0; c < BALLS - 1; c++)
            measured("e", answer.contacts[c].restitution, cvode.contacts[c].restitution,
                     answer.tolerance_met ? fmin(reported, 1e-3) : reported);
        assert_true(answer.tolerance_met);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_agree_with_cvode),
        cmocka_unit_test(long_columns_say_how_wrong_they_are),
        cmocka_unit_test(short_blows_within_long_contacts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
