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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_agree_with_cvode),
        cmocka_unit_test(long_columns_say_how_wrong_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
