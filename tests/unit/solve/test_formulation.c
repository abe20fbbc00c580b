/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/formulation.c: gap rates, W and Eq. (4) from a request, and its
 * refusals.
 */
#include "physics/support.h"
#include "solve/formulation.h"

static struct lab *shapes(void)
{
    struct lab *lab = lab_create();
    struct body block = make_body(&block_kind, STEEL);
    memcpy(block.size, (double[]){0.1, 0.06, 0.04}, sizeof block.size);
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "drum", make_bar(&cylinder_kind, STEEL, 0.02, 0.05));
    lab_add(lab, "wall", make_body(&half_space_kind, STEEL));
    lab_add(lab, "block", block);
    return lab;
}

static struct solve_request ball_on_beam(void)
{
    return strike(sphere_spot("ball", 0.015), side_spot("beam", 0.1, 0.010, 0.0), 0.2);
}

static struct problem *find(struct lab *lab, const struct solve_request *request,
                            struct arena *arena)
{
    struct fault fault = {""};
    struct prepared_cache *cache = prepared_cache_create();
    struct problem *problem = problem_create(request, cache, arena);
    assert_non_null(cache);
    assert_non_null(problem);
    if (placement_find(problem, &lab->set, &fault))
        fail_msg("%s", fault.text);
    prepared_cache_free(cache);
    problem->cache = NULL;
    return problem;
}

/* n.(v_A - v_B) at the point, rotation included. */
static void gap_rates_count_rotation(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct arena arena = {0};
    struct solve_request request = ball_on_beam();
    memcpy(request.bodies[0].angular_velocity, (double[]){3.0, 4.0, 5.0}, 3 * sizeof(double));
    memcpy(request.bodies[1].velocity, (double[]){0.1, -0.3, 0.05}, 3 * sizeof(double));
    memcpy(request.bodies[1].angular_velocity, (double[]){0.0, 0.7, 0.0}, 3 * sizeof(double));
    struct problem *problem = find(lab, &request, &arena);
    /* the ball's contact is below its centre: its spin has no part along z; the beam's centre lies
     * at x = -0.1, and turning about y by 0.7 rad/s moves the point by -0.07 m/s along z */
    measured("gap rate", problem->gap_rate[0], -0.2 - (0.05 - 0.07), 1e-15);
    arena_release(&arena);
    lab_free(lab);
}

static void w_and_eq_4(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct arena arena = {0};
    struct solve_request request = ball_on_beam();
    struct problem *problem = find(lab, &request, &arena);
    const struct body *ball = problem->bodies[0], *beam = problem->bodies[1];
    double w = 1.0 / ball->mass + 1.0 / beam->mass + 0.01 / beam->inertia[1];
    measured_relative("W", problem->w[0], w, 1e-14);
    measured_relative("compression", problem->impulse_compression[0], 0.2 / w, 1e-14);
    /* the sphere on the beam: the notes' k */
    measured_relative("k", problem->hertz[0].stiffness, 7.74365e9, 6e-7);
    double mine = 3.0;
    request.delassus = &mine;
    problem = find(lab, &request, &arena);
    assert_true(problem->from_client && problem->w[0] == 3.0);
    measured_relative("service's", problem_inverse_mass(problem, 0, 0), w, 1e-14);
    measured_relative("compression", problem->impulse_compression[0], 0.2 / 3.0, 1e-14);
    arena_release(&arena);
    lab_free(lab);
}

/* Two balls on one beam: W couples them through the beam, w_1^T M^-1 w_2. */
static void contacts_couple_through_their_bodies(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct arena arena = {0};
    struct solve_request request = ball_on_beam();
    request.body_count = 3;
    request.contact_count = 2;
    request.bodies[2] = request.bodies[0];
    request.bodies[2].position[0] = -0.3; /* on the beam at x = -0.2 of its own */
    request.contacts[1] = request.contacts[0];
    request.contacts[1].a = 2;
    request.contacts[1].point[0] = -0.3;
    struct problem *problem = find(lab, &request, &arena);
    const struct body *beam = problem->bodies[1];
    double shared = 1.0 / beam->mass + 0.1 * -0.2 / beam->inertia[1];
    measured_relative("W12", problem->w[1], shared, 1e-12);
    assert_true(problem->w[1] == problem->w[2]);
    /* Eq. (4) for both: W P = 0.2 (both press) */
    for (int c = 0; c < 2; c++)
        measured("residual",
                 problem->w[2 * c] * problem->impulse_compression[0] +
                     problem->w[2 * c + 1] * problem->impulse_compression[1],
                 0.2, 1e-9);
    arena_release(&arena);
    lab_free(lab);
}

static void refuse(struct lab *lab, const struct solve_request *request, enum percuss_status status,
                   const char *words)
{
    static struct solve_result result;
    enum percuss_status answer = solve(lab->workspace, &lab->means, request, &result);
    if (answer != status || strstr(result.fault.text, words) == NULL)
        fail_msg("%s: \"%s\"\nexpected \"%s\"", status_name(answer), result.fault.text, words);
    assert_int_equal(result.status, status);
}

static void refuses_bodies_and_contacts(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = ball_on_beam();
    const struct spot face = end_spot("rod", 1.0), drum = side_spot("drum", 0.0, 0.02, 0.0);
    const struct spot top = {"block", {0.0, 0.0, 0.02}, {0.0, 0.0, 1.0}, 0.0};
    snprintf(request.bodies[1].id, sizeof request.bodies[1].id, "boom");
    refuse(lab, &request, PERCUSS_UNKNOWN_BODY, "bodies[1].id: 'boom'");
    request = ball_on_beam();
    request.contacts[0].b = 0;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "contacts[0]: a 0, b 0");
    request.contacts[0].b = 7;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "contacts[0]: a 0, b 7");
    request.contact_count = 0;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "contacts: 0 given");
    request.body_count = 65;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "bodies: 65 given");
    request = strike(wall_spot("wall"), wall_spot("wall"), 0.1);
    refuse(lab, &request, PERCUSS_UNSUPPORTED_GEOMETRY, "two planes");
    request = strike(face, top, 0.1);
    refuse(lab, &request, PERCUSS_UNSUPPORTED_GEOMETRY, "touch in a face");
    request = strike(drum, top, 0.1);
    refuse(lab, &request, PERCUSS_UNSUPPORTED_GEOMETRY, "touch in a line");
    request = strike(drum, side_spot("beam", 0.0, 0.010, 0.0), 0.1); /* parallel axes */
    refuse(lab, &request, PERCUSS_UNSUPPORTED_GEOMETRY, "touch in a line");
    lab_free(lab);
}

static void refuses_motions(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = ball_on_beam();
    request.bodies[0].velocity[2] = 0.2;
    refuse(lab, &request, PERCUSS_NOT_APPROACHING, "gap rate n.(v_a - v_b) = +0.2");
    request.bodies[0].velocity[2] = 0.0;
    refuse(lab, &request, PERCUSS_NOT_APPROACHING, "+0");
    request.bodies[0].velocity[2] = -2e4;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "at most 10000 m/s");
    request = ball_on_beam();
    request.contacts[0].gap = NAN;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "contacts[0].gap");
    request = ball_on_beam();
    request.contacts[0].gap_acceleration = INFINITY;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "contacts[0].gap_acceleration");
    request = ball_on_beam();
    request.options.tolerance = NAN;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "options.tolerance");
    request = ball_on_beam();
    request.options.horizon = -1.0;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "options.horizon");
    lab_free(lab);
}

static void refuses_matrices(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct solve_request request = ball_on_beam();
    double w[4] = {0.0};
    request.delassus = w;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "delassus[0]: 0: the diagonal");
    w[0] = NAN;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "delassus[0]");
    w[0] = INFINITY;
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "delassus[0]");
    request.contact_count = 2; /* one contact stated twice */
    request.contacts[1] = request.contacts[0];
    memcpy(w, (double[]){2.0, 3.0, 3.0, 2.0}, sizeof w);
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "positive semidefinite");
    memcpy(w, (double[]){2.0, NAN, NAN, 2.0}, sizeof w);
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "delassus");
    /* the notes: W must be symmetric */
    memcpy(w, (double[]){2.0, 1.0, 0.2, 2.0}, sizeof w);
    refuse(lab, &request, PERCUSS_BAD_REQUEST, "symmetric");
    lab_free(lab);
}

/* A place that is kept has the bits of one that is found, whichever body comes first in a request;
 * what differs between requests is each one's own. */
static void a_kept_place_is_the_same(void **state)
{
    (void)state;
    struct lab *lab = shapes();
    struct arena arena = {0};
    struct fault fault = {""};
    struct prepared_cache *cache = prepared_cache_create();
    struct solve_request request = ball_on_beam();
    struct problem *first = find(lab, &request, &arena);
    for (int i = 0; i < 5; i++) {
        struct solve_request again = request;
        if (i % 2) {
            again.bodies[0] = request.bodies[1];
            again.bodies[1] = request.bodies[0];
            again.contacts[0].a = request.contacts[0].b;
            again.contacts[0].b = request.contacts[0].a;
        }
        again.bodies[i % 2].velocity[2] = -0.3;
        struct problem *problem = problem_create(&again, cache, &arena);
        assert_non_null(problem);
        assert_int_equal(placement_find(problem, &lab->set, &fault), PERCUSS_OK);
        assert_memory_equal(problem->hertz, first->hertz, sizeof *problem->hertz);
        assert_true(problem->w[0] == first->w[0]);
        assert_true(problem->gap_rate[0] == -0.3);
        for (int which = 0; which < 2; which++) {
            const struct contact_side *mine = &problem->sides[0][which];
            const struct contact_side *other = &first->sides[0][which];
            assert_int_equal(mine->body, i % 2 ? 1 - other->body : other->body);
            assert_int_equal(mine->site.face, other->site.face);
            assert_memory_equal(mine->site.point, other->site.point, sizeof mine->site.point);
            assert_memory_equal(mine->site.curvature, other->site.curvature,
                                sizeof mine->site.curvature);
            assert_memory_equal(mine->direction, other->direction, sizeof mine->direction);
            assert_true(mine->material.young == other->material.young);
            for (size_t f = 0; f < BODY_MOST_FAMILIES; f++) {
                const struct beam_load *load = &mine->load.family[f].bar;
                assert_int_equal(mine->load.family[f].acts, other->load.family[f].acts);
                if (mine->load.family[f].acts)
                    assert_true(load->x == other->load.family[f].bar.x &&
                                load->force == other->load.family[f].bar.force);
            }
        }
    }
    prepared_cache_free(cache);
    arena_release(&arena);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gap_rates_count_rotation),
        cmocka_unit_test(w_and_eq_4),
        cmocka_unit_test(contacts_couple_through_their_bodies),
        cmocka_unit_test(refuses_bodies_and_contacts),
        cmocka_unit_test(refuses_motions),
        cmocka_unit_test(refuses_matrices),
        cmocka_unit_test(a_kept_place_is_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
