/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/error/total.c: a single contact's errors are those of its restitution;
 * those of a long row say what is known of it where the restitution's says nothing. */
#include "physics/support.h"

static struct solve_result result;

static void a_single_contact_has_its_restitutions(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.1, 0.010, 0.0), 0.2);
    lab_solve(lab, &request, &result);
    const struct solve_contact_result *contact = &result.contacts[0];
    double error = result.restitution_total * contact->impulse_compression;
    assert_true(error > 0.0);
    near_relative(contact->impulse_error, error, 1e-15);
    /* a ball hit through its centre does not turn; a beam hit beside it does */
    near_relative(result.bodies[0].velocity_error, error / lab->bodies[0].mass, 1e-12);
    assert_true(result.bodies[0].angular_velocity_error < 1e-12 * result.bodies[0].velocity_error);
    near_relative(result.bodies[1].velocity_error, error / lab->bodies[1].mass, 1e-12);
    near_relative(result.bodies[1].angular_velocity_error, 0.1 * error / lab->bodies[1].inertia[1],
                  1e-12);
    lab_free(lab);
}

enum { BALLS = 32 };

/* A row of balls, hit from above. */
static struct solve_request make_row(struct lab *lab)
{
    struct solve_request request = {.body_count = BALLS, .contact_count = BALLS - 1};
    uint64_t r = 7;
    double z = 0.0;
    for (size_t i = 0; i < BALLS; i++) {
        struct solve_body *body = &request.bodies[i];
        double radius = random_between(&r, 0.005, 0.006);
        *body = (struct solve_body){.orientation = {1.0, 0.0, 0.0, 0.0}};
        snprintf(body->id, sizeof body->id, "s%zu", i);
        lab_add(lab, body->id, make_sphere(STEEL, radius));
        body->position[2] = z - radius;
        body->velocity[2] = i ? 0.0 : -0.5;
        if (i)
            request.contacts[i - 1] = (struct solve_contact){.a = (unsigned)i - 1,
                                                             .b = (unsigned)i,
                                                             .point = {0.0, 0.0, z},
                                                             .normal = {0.0, 0.0, 1.0}};
        z -= 2.0 * radius;
    }
    return request;
}

/* With contacts stiffer by as much as is unknown of them: two of the deviations that the error of
 * the models stands for. Every impulse and velocity stays within its own error, which is a tenth of
 * the blow's at most. */
static void a_long_row_has_its_own(void **state)
{
    (void)state;
    static struct solve_result other;
    struct lab *lab = lab_create();
    struct solve_request request = make_row(lab);
    lab_solve(lab, &request, &result);
    request.options.tolerance = 1e-5;
    request.model_shift[SOLVE_SHIFT_FORCE] = 2.0;
    request.model_shift[SOLVE_SHIFT_COMPLIANCE] = 2.0;
    lab_solve(lab, &request, &other);
    double largest = 0.0, farthest = 0.0;
    for (size_t c = 0; c + 1 < BALLS; c++)
        assert_true(fabs(result.contacts[c].impulse - other.contacts[c].impulse) <=
                    result.contacts[c].impulse_error);
    for (size_t b = 0; b < BALLS; b++) {
        double off = fabs(result.bodies[b].velocity[2] - other.bodies[b].velocity[2]);
        assert_true(off <= result.bodies[b].velocity_error);
        farthest = fmax(farthest, off);
        largest = fmax(largest, result.bodies[b].velocity_error);
    }
    printf("restitution +- %g, velocities +- %g m/s, off by %g\n", result.restitution_total,
           largest, farthest);
    assert_true(farthest > 0.0 && largest < 0.1 * 0.5);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_single_contact_has_its_restitutions),
        cmocka_unit_test(a_long_row_has_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
