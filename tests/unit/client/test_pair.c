/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api/pair.c: for every pair of shapes the bodies touch at one point with opposite
 * normals and approach at the wanted speed. */
#include <percuss/percuss.h>
#include <string.h>

#include "check.h"

/* With dimensions that differ in every direction. */
static const struct percuss_body shapes[] = {
    {.id = "s", .shape = "sphere", .half_extents = {0.015, 0.015, 0.015}, .radius = 0.015},
    {.id = "r",
     .shape = "rod",
     .half_extents = {0.5, 0.01, 0.01},
     .radius = 0.01,
     .tip_radius = INFINITY},
    {.id = "R",
     .shape = "rod",
     .half_extents = {0.4, 0.02, 0.02},
     .radius = 0.02,
     .tip_radius = 0.02,
     .supports = {PERCUSS_SUPPORT_FREE, PERCUSS_SUPPORT_CLAMPED}},
    {.id = "b", .shape = "beam", .half_extents = {0.5, 0.01, 0.01}, .radius = 0.01},
    {.id = "B", .shape = "beam", .half_extents = {0.6, 0.005, 0.007}},
    {.id = "c", .shape = "cylinder", .half_extents = {0.03, 0.02, 0.02}, .radius = 0.02},
    {.id = "k", .shape = "block", .half_extents = {0.1, 0.2, 0.3}},
    {.id = "h", .shape = "half-space", .mass = INFINITY},
};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

static const double tolerance = 1e-15; /* rounding of quarter turns of lengths below 1 m */

static struct percuss_request request;

static void place(const struct percuss_body *a, const struct percuss_body *b, double at)
{
    struct percuss_pair pair = percuss_pair_default(a, b);
    pair.speed = 0.3;
    pair.at_a = pair.at_b = at;
    if (percuss_contact_pair(&pair, &request) != PERCUSS_RESULT_OK)
        fail_msg("%s on %s: %s", a->id, b->id, percuss_error_text());
}

/* Rotation by the quaternion's matrix, or by its inverse: another way than the code's. */
static void turn(const double q[4], const double v[3], bool back, double result[3])
{
    double w = q[0], x = back ? -q[1] : q[1], y = back ? -q[2] : q[2], z = back ? -q[3] : q[3];
    double matrix[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
    };
    for (int i = 0; i < 3; i++)
        result[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
}

/* The point and outward normal that the request gives a body, in the body's frame. */
static void site_of(int which, double point[3], double normal[3])
{
    const struct percuss_body_motion *body = &request.bodies[which];
    double from_centre[3], outward[3];
    for (int i = 0; i < 3; i++) {
        from_centre[i] = request.contacts[0].point[i] - body->position[i];
        outward[i] = (which == 0 ? -1.0 : 1.0) * request.contacts[0].normal[i];
    }
    turn(body->orientation, from_centre, true, point);
    turn(body->orientation, outward, true, normal);
}

static void expect_vector(const double got[3], double x, double y, double z)
{
    const double expected[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        if (!(fabs(got[i] - expected[i]) <= tolerance))
            fail_msg("(%g %g %g) instead of (%g %g %g)", got[0], got[1], got[2], x, y, z);
}

/* The default site of the contract, written down once more by hand. */
static void expect_default_site(const struct percuss_body *body, const double point[3],
                                const double normal[3])
{
    const double *half = body->half_extents;
    if (!strcmp(body->shape, "rod")) {
        double side = body->supports[1] == PERCUSS_SUPPORT_FREE ? 1.0 : -1.0;
        expect_vector(point, side * half[0], 0.0, 0.0);
        expect_vector(normal, side, 0.0, 0.0);
    } else if (!strcmp(body->shape, "cylinder")) {
        expect_vector(point, half[0], 0.0, 0.0);
        expect_vector(normal, 1.0, 0.0, 0.0);
    } else if (!strcmp(body->shape, "beam")) {
        expect_vector(point, -0.5 * half[0], 0.0, half[2]); /* at 0.25 of the length */
        expect_vector(normal, 0.0, 0.0, 1.0);
    } else {
        expect_vector(point, 0.0, 0.0, half[2]);
        expect_vector(normal, 0.0, 0.0, 1.0);
    }
}

static void every_pair_touches_at_its_sites(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        for (int j = 0; j < SHAPES; j++) {
            double point[3], normal[3];
            place(&shapes[i], &shapes[j], 0.25);
            assert_int_equal(request.body_count, 2);
            assert_int_equal(request.contact_count, 1);
            assert_int_equal(request.contacts[0].a, 0);
            assert_int_equal(request.contacts[0].b, 1);
            assert_string_equal(request.bodies[0].id, shapes[i].id);
            assert_string_equal(request.bodies[1].id, shapes[j].id);
            site_of(0, point, normal);
            expect_default_site(&shapes[i], point, normal);
            site_of(1, point, normal);
            expect_default_site(&shapes[j], point, normal);
        }
    }
}

static void every_pair_approaches(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        for (int j = 0; j < SHAPES; j++) {
            place(&shapes[i], &shapes[j], 0.5);
            const double *n = request.contacts[0].normal, *q = request.bodies[0].orientation;
            expect_vector(request.bodies[0].velocity, -0.3 * n[0], -0.3 * n[1], -0.3 * n[2]);
            expect_vector(request.bodies[0].angular_velocity, 0.0, 0.0, 0.0);
            expect_vector(request.bodies[1].velocity, 0.0, 0.0, 0.0);
            expect_vector(request.bodies[1].position, 0.0, 0.0, 0.0);
            assert_true(request.bodies[1].orientation[0] == 1.0);
            assert_true(fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0) <
                        tolerance);
        }
    }
}

static void places_the_sphere_of_the_contract(void **state)
{
    (void)state;
    place(&shapes[0], &shapes[3], 0.5);
    expect_vector(request.bodies[0].position, 0.0, 0.0, 0.025);
    expect_vector(request.bodies[0].velocity, 0.0, 0.0, -0.3);
    expect_vector(request.contacts[0].point, 0.0, 0.0, 0.010);
    expect_vector(request.contacts[0].normal, 0.0, 0.0, 1.0);
    place(&shapes[0], &shapes[3], 0.0);
    expect_vector(request.contacts[0].point, -0.5, 0.0, 0.010);
    place(&shapes[0], &shapes[3], 1.0);
    expect_vector(request.contacts[0].point, 0.5, 0.0, 0.010);
}

static void beams_cross_at_a_right_angle(void **state)
{
    (void)state;
    static const double axis[3] = {1.0, 0.0, 0.0};
    double turned[3];
    for (int i = 3; i <= 4; i++) {
        for (int j = 3; j <= 4; j++) {
            place(&shapes[i], &shapes[j], 0.5);
            turn(request.bodies[0].orientation, axis, false, turned);
            expect_vector(turned, 0.0, 1.0, 0.0);
        }
    }
    /* a rod stands upright on a beam, which is across as well */
    place(&shapes[1], &shapes[3], 0.5);
    turn(request.bodies[0].orientation, axis, false, turned);
    expect_vector(turned, 0.0, 0.0, -1.0);
}

static void refuses_what_it_cannot_place(void **state)
{
    (void)state;
    const struct percuss_body plate = {.id = "plate", .shape = "half-disc"};
    struct percuss_pair pair = percuss_pair_default(&shapes[0], &plate);
    pair.speed = 1.0;
    assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_error_text(), "plate: a body of shape 'half-disc'"));
    const double speeds[] = {0.0, -1.0, INFINITY, NAN};
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++) {
        pair = percuss_pair_default(&shapes[0], &shapes[3]);
        pair.speed = speeds[i];
        assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_INVALID_ARGUMENT);
        assert_non_null(strstr(percuss_error_text(), "speed: "));
    }
    pair.speed = 1.0;
    pair.at_b = 1.5;
    assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_error_text(), "at: 1.5"));
}

static void a_body_is_found_or_a_similar_one_named(void **state)
{
    (void)state;
    struct percuss_body bodies[] = {{.id = "al-beam"}, {.id = "al-rod"}};
    const struct percuss_body_list list = {.count = 2, .bodies = bodies};
    assert_ptr_equal(percuss_body_find(&list, "al-rod"), &bodies[1]);
    assert_null(percuss_body_find(&list, "al-rodd"));
    assert_string_equal(percuss_error_text(),
                        "id: 'al-rodd': no such body among 2; did you mean 'al-rod'?");
    assert_null(percuss_body_find(&list, "concrete-wall"));
    assert_string_equal(percuss_error_text(), "id: 'concrete-wall': no such body among 2");
}

/* Slip of A's point against B's along a direction. */
static double slip_along(const double direction[3])
{
    const struct percuss_body_motion *a = &request.bodies[0];
    double arm[3], slip = 0.0;
    for (int i = 0; i < 3; i++)
        arm[i] = request.contacts[0].point[i] - a->position[i];
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double turning = a->angular_velocity[j] * arm[k] - a->angular_velocity[k] * arm[j];
        slip += direction[i] * (a->velocity[i] + turning);
    }
    return slip;
}

/* A sphere at 0.3 m/s, 30 degrees from the normal of a beam along x: towards +x, and a spin adds.
 */
static void a_flight_leans(void **state)
{
    (void)state;
    struct percuss_pair pair = percuss_pair_default(&shapes[0], &shapes[3]);
    const double *normal = request.contacts[0].normal, *tangent = request.contacts[0].tangent;
    pair.speed = 0.3;
    pair.angle = M_PI / 6.0;
    pair.friction = 0.2;
    assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_OK);
    expect_vector(normal, 0.0, 0.0, 1.0);
    expect_vector(tangent, 1.0, 0.0, 0.0);
    assert_true(request.contacts[0].friction == 0.2);
    expect_vector(request.bodies[0].velocity, 0.15, 0.0, -0.3 * sqrt(0.75));
    assert_true(fabs(slip_along(tangent) - 0.15) < tolerance);
    /* a rolling sphere does not slip; turned the other way it slips twice as fast */
    pair.spin = -10.0;
    assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_OK);
    assert_true(fabs(slip_along(tangent)) < tolerance);
    pair.spin = 10.0;
    assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_OK);
    assert_true(fabs(slip_along(tangent) - 0.3) < tolerance);
    assert_true(fabs(slip_along(normal) + 0.3 * sqrt(0.75)) < tolerance);
}

/* Whatever the normal, the tangent is a unit vector across it. */
static void a_tangent_lies_across_any_normal(void **state)
{
    (void)state;
    struct percuss_body mesh = {.id = "m", .shape = "mesh", .site_count = 1};
    const double normals[][3] = {{0.6, 0.0, 0.8}, {-0.8, 0.6, 0.0}, {2.0 / 3, 2.0 / 3, -1.0 / 3}};
    const double *tangent = request.contacts[0].tangent;
    strcpy(mesh.sites[0].name, "s");
    for (size_t i = 0; i < sizeof normals / sizeof *normals; i++) {
        memcpy(mesh.sites[0].normal, normals[i], sizeof normals[i]);
        struct percuss_pair pair = percuss_pair_default(&shapes[0], &mesh);
        pair.speed = 1.0;
        pair.angle = -1.0;
        assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_OK);
        double square = 0.0, along = 0.0;
        for (int k = 0; k < 3; k++) {
            square += tangent[k] * tangent[k];
            along += tangent[k] * normals[i][k];
        }
        assert_true(fabs(square - 1.0) < tolerance && fabs(along) < tolerance);
        assert_true(fabs(slip_along(tangent) - sin(-1.0)) < tolerance);
        assert_true(fabs(slip_along(normals[i]) + cos(1.0)) < tolerance);
    }
}

static void refuses_a_flight_that_misses(void **state)
{
    (void)state;
    struct percuss_pair pair = percuss_pair_default(&shapes[0], &shapes[3]);
    pair.speed = 0.3;
    const double angles[] = {M_PI_2, -2.0, NAN};
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        pair.angle = angles[i];
        assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_INVALID_ARGUMENT);
        assert_non_null(strstr(percuss_error_text(), "angle: "));
    }
    pair.angle = 0.0;
    pair.spin = INFINITY;
    assert_int_equal(percuss_contact_pair(&pair, &request), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_string_equal(percuss_error_text(), "spin: inf rad/s: must be finite");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pair_touches_at_its_sites),
        cmocka_unit_test(every_pair_approaches),
        cmocka_unit_test(places_the_sphere_of_the_contract),
        cmocka_unit_test(beams_cross_at_a_right_angle),
        cmocka_unit_test(refuses_what_it_cannot_place),
        cmocka_unit_test(a_flight_leans),
        cmocka_unit_test(a_tangent_lies_across_any_normal),
        cmocka_unit_test(refuses_a_flight_that_misses),
        cmocka_unit_test(a_body_is_found_or_a_similar_one_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
