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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_agree_with_cvode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
