/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/site.c: faces, normals, curvatures and edges of every shape, in any pose,
 * and what is refused with which words. */
#include <string.h>

#include "check.h"
#include "model/site.h"
#include "model/vector.h"

static struct body make(const struct body_kind *kind)
{
    struct body body = {
        .id = "thing",
        .material = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0},
        .kind = kind,
        .radius = 0.01,
        .length = 0.2,
        .tip_radius = INFINITY,
        .size = {0.1, 0.06, 0.04},
    };
    return body;
}

static struct body flat_beam(void)
{
    struct body body = make(&beam_kind);
    body.radius = 0.0;
    body.width = 0.03;
    body.height = 0.01;
    body.shear_rule = SHEAR_COWPER; /* else its vibration is a block's */
    return body;
}

static struct body tipped_rod(void)
{
    struct body body = make(&rod_kind);
    body.tip_radius = 0.025;
    return body;
}

/* An arbitrary pose. */
static struct pose posed(void)
{
    const double q[4] = {0.5, -0.1, 0.7, 0.5};
    struct pose pose = {.position = {1.0, -2.0, 0.5}};
    rotation_matrix(q, pose.rotation);
    return pose;
}

static enum percuss_status locate(struct body *body, const double point[3], const double outward[3],
                                  struct site *site, struct fault *fault)
{
    struct pose pose = posed();
    double world[3], normal[3];
    assert_int_equal(body_complete(body, fault), PERCUSS_OK);
    rotate3(pose.rotation, point, world);
    add_scaled3(1.0, pose.position, world);
    rotate3(pose.rotation, outward, normal);
    return site_locate(body, &pose, world, normal, 0.001, 2, site, fault);
}

/* Curvature along a direction, t.C t. */
static double bend(const struct site *site, double x, double y, double z)
{
    const double t[3] = {x, y, z};
    double image[3];
    rotate3(site->curvature, t, image);
    return dot3(t, image);
}

static void every_shape_has_its_faces(void **state)
{
    (void)state;
    const struct {
        struct body body;
        double point[3], outward[3];
        enum site_face face;
        double bends[3]; /* curvature along x, y, z */
    } cases[] = {
        {make(&sphere_kind), {0, 0, 0.01}, {0, 0, 1}, SITE_ROUND, {100, 100, 0}},
        {make(&sphere_kind), {-0.01, 0, 0}, {-1, 0, 0}, SITE_ROUND, {0, 100, 100}},
        {make(&rod_kind), {0.1, 0, 0}, {1, 0, 0}, SITE_END, {0, 0, 0}},
        {tipped_rod(), {-0.1, 0, 0}, {-1, 0, 0}, SITE_END, {0, 40, 40}},
        {make(&beam_kind), {0.05, 0, 0.01}, {0, 0, 1}, SITE_BEAM_SIDE, {0, 100, 0}},
        {make(&beam_kind), {0.05, -0.01, 0}, {0, -1, 0}, SITE_BEAM_SIDE, {0, 0, 100}},
        {make(&beam_kind), {-0.1, 0.005, 0}, {-1, 0, 0}, SITE_END, {0, 0, 0}},
        {flat_beam(), {-0.05, 0.01, 0.005}, {0, 0, 1}, SITE_BEAM_SIDE, {0, 0, 0}},
        {flat_beam(), {-0.05, 0.015, 0.001}, {0, 1, 0}, SITE_BEAM_SIDE, {0, 0, 0}},
        {flat_beam(), {0.1, 0.01, -0.002}, {1, 0, 0}, SITE_END, {0, 0, 0}},
        {make(&cylinder_kind), {0.02, 0, -0.01}, {0, 0, -1}, SITE_ROUND, {0, 100, 0}},
        {make(&cylinder_kind), {0.1, 0.002, 0}, {1, 0, 0}, SITE_END, {0, 0, 0}},
        {make(&block_kind), {0.05, 0.01, -0.01}, {1, 0, 0}, SITE_ROUND, {0, 0, 0}},
        {make(&block_kind), {0.02, 0.01, -0.02}, {0, 0, -1}, SITE_ROUND, {0, 0, 0}},
        {make(&half_space_kind), {3, -7, 0}, {0, 0, 1}, SITE_ROUND, {0, 0, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct body body = cases[i].body;
        struct site site;
        struct fault fault = {""};
        if (locate(&body, cases[i].point, cases[i].outward, &site, &fault))
            fail_msg("case %zu: %s", i, fault.text);
        assert_int_equal(site.face, cases[i].face);
        for (int k = 0; k < 3; k++) {
            /* a pose with positions of 1 m: roundings of 1e-16 m over 1 cm */
            near(site.point[k], cases[i].point[k], 1e-14);
            near(site.outward[k], cases[i].outward[k], 1e-12);
            near(bend(&site, k == 0, k == 1, k == 2), cases[i].bends[k], 1e-9);
        }
        near(site.distance, 0.0, 1e-14);
    }
}

/* Oblique points of round faces: normals by position, curvature around the axis only. */
static void round_faces_turn_with_the_point(void **state)
{
    (void)state;
    for (double angle = 0.1; angle < 6.3; angle += 0.7) {
        double c = cos(angle), s = sin(angle);
        struct body body = make(&beam_kind);
        struct site site;
        struct fault fault = {""};
        /* 0.4 mm outside */
        const double point[3] = {0.03, 0.0104 * c, 0.0104 * s};
        assert_int_equal(locate(&body, point, (double[]){0.0, c, s}, &site, &fault), PERCUSS_OK);
        near(site.distance, 0.0004, 1e-14);
        near(site.outward[1], c, 1e-12);
        near(bend(&site, 0.0, -s, c), 100.0, 1e-9);
        near(bend(&site, 1.0, 0.0, 0.0), 0.0, 1e-9);
        near(bend(&site, 0.0, c, s), 0.0, 1e-9);
        struct body ball = make(&sphere_kind);
        const double inside[3] = {0.0093 * c, 0.0, 0.0093 * s};
        assert_int_equal(locate(&ball, inside, (double[]){c, 0.0, s}, &site, &fault), PERCUSS_OK);
        near(site.distance, -0.0007, 1e-14);
        near(bend(&site, 0.0, 1.0, 0.0), 100.0, 1e-9);
        near(bend(&site, -s, 0.0, c), 100.0, 1e-9);
    }
}

static void refuse(struct body body, double x, double y, double z, const double outward[3],
                   enum percuss_status status, const char *words)
{
    struct site site;
    struct fault fault = {""};
    const double point[3] = {x, y, z};
    enum percuss_status answer = locate(&body, point, outward, &site, &fault);
    if (answer != status || strstr(fault.text, words) == NULL)
        fail_msg("%s: \"%s\"\nexpected \"%s\"", status_name(answer), fault.text, words);
    assert_non_null(strstr(fault.text, "contacts[2]"));
    assert_non_null(strstr(fault.text, "thing"));
}

static void refuses_with_words(void **state)
{
    (void)state;
    static const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1}, down[3] = {0, 0, -1};
    const double tilted[3] = {0.0, sin(0.12), cos(0.12)}; /* 6.9 degrees */
    const double edge[3] = {M_SQRT1_2, 0.0, M_SQRT1_2};   /* 45 degrees */
    struct body held = make(&beam_kind);
    held.supports[1] = SUPPORT_PINNED;
    refuse(make(&sphere_kind), 0, 0, 0.0115, z, PERCUSS_BAD_REQUEST,
           "contacts[2].point: lies 0.0015 m off the surface");
    refuse(make(&sphere_kind), 0, 0, 0, z, PERCUSS_BAD_REQUEST, "contacts[2].point: lies 0.01 m");
    refuse(make(&beam_kind), 0.15, 0, 0.01, z, PERCUSS_BAD_REQUEST, "off the surface");
    refuse(make(&sphere_kind), 0, 0, 0.01, down, PERCUSS_BAD_REQUEST,
           "contacts[2].normal: points from a to b");
    refuse(make(&sphere_kind), 0, 0, 0.01, tilted, PERCUSS_BAD_REQUEST, "6.88 degrees off");
    refuse(make(&beam_kind), 0.05, 0, 0.01, x, PERCUSS_BAD_REQUEST, "90 degrees off");
    refuse(make(&beam_kind), 0.1, 0, 0.01, edge, PERCUSS_UNSUPPORTED_GEOMETRY, "on an edge");
    refuse(make(&block_kind), 0.05, 0, 0.02, edge, PERCUSS_UNSUPPORTED_GEOMETRY, "on an edge");
    refuse(make(&beam_kind), 0.1005, 0, 0.01, z, PERCUSS_UNSUPPORTED_GEOMETRY,
           "beyond the edge of the face");
    refuse(make(&rod_kind), 0.02, 0, 0.01, z, PERCUSS_UNSUPPORTED_GEOMETRY,
           "a rod has longitudinal waves only: declare it as shape: beam");
    refuse(make(&rod_kind), 0.1, 0.002, 0, x, PERCUSS_UNSUPPORTED_GEOMETRY,
           "beside the axis bends it");
    refuse(held, 0.1, 0, 0, x, PERCUSS_UNSUPPORTED_GEOMETRY, "held by a support");
    refuse(make(&half_space_kind), 0, 0, 0.002, z, PERCUSS_BAD_REQUEST, "0.002 m off");
}

static void what_is_just_allowed(void **state)
{
    (void)state;
    struct site site;
    struct fault fault = {""};
    struct body ball = make(&sphere_kind), beam = make(&beam_kind), rod = make(&rod_kind);
    const double tilted[3] = {0.0, sin(0.087), cos(0.087)}; /* 4.98 degrees */
    const double up[3] = {0, 0, 1}, along[3] = {1, 0, 0};
    assert_int_equal(locate(&ball, (double[]){0, 0, 0.01099}, up, &site, &fault), PERCUSS_OK);
    assert_int_equal(locate(&ball, (double[]){0, 0, 0.01}, tilted, &site, &fault), PERCUSS_OK);
    near(site.outward[2], 1.0, 1e-12); /* the surface's, not the stated one */
    /* the free end of a beam held elsewhere; the side right above a support */
    beam.supports[0] = SUPPORT_CLAMPED;
    assert_int_equal(locate(&beam, (double[]){0.1, 0, 0}, along, &site, &fault), PERCUSS_OK);
    assert_int_equal(locate(&beam, (double[]){-0.1, 0, 0.01}, up, &site, &fault), PERCUSS_OK);
    assert_true(site.at_edge);
    assert_int_equal(locate(&beam, (double[]){-0.098, 0, 0.01}, up, &site, &fault), PERCUSS_OK);
    assert_false(site.at_edge);
    assert_int_equal(locate(&rod, (double[]){0.1, 0.0009, 0}, along, &site, &fault), PERCUSS_OK);
}

/* Two cylinders crossed at an angle (Johnson, section 4.1): A + B = (1/R1 + 1/R2)/2,
 * B - A = sqrt(1/R1^2 + 1/R2^2 + 2 cos(2 angle)/(R1 R2))/2. */
static void relative_curvatures_of_crossed_cylinders(void **state)
{
    (void)state;
    for (double angle = 0.0; angle < 1.6; angle += 0.2) {
        struct body thick = make(&cylinder_kind), thin = make(&cylinder_kind);
        struct site a, b;
        struct fault fault = {""};
        struct pose upper = {.position = {0.0, 0.0, 0.03}}, lower = {.position = {0.0, 0.0, -0.01}};
        const double origin[3] = {0.0, 0.0, 0.0}, up[3] = {0, 0, 1}, down[3] = {0, 0, -1};
        double curvature[2];
        thick.radius = 0.03;
        assert_int_equal(body_complete(&thick, NULL) | body_complete(&thin, NULL), PERCUSS_OK);
        rotation_matrix((double[]){cos(0.5 * angle), 0.0, 0.0, sin(0.5 * angle)}, upper.rotation);
        rotation_matrix((double[]){1.0, 0.0, 0.0, 0.0}, lower.rotation);
        assert_int_equal(site_locate(&thick, &upper, origin, down, 0.001, 0, &a, &fault),
                         PERCUSS_OK);
        assert_int_equal(site_locate(&thin, &lower, origin, up, 0.001, 0, &b, &fault), PERCUSS_OK);
        site_relative_curvature(&a, &upper, &b, &lower, up, curvature);
        double p = 1.0 / 0.03, q = 100.0;
        near(curvature[0] + curvature[1], 0.5 * (p + q), 1e-12);
        near(curvature[1] - curvature[0],
             0.5 * sqrt(p * p + q * q + 2.0 * p * q * cos(2.0 * angle)), 1e-12);
        assert_true(curvature[0] <= curvature[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape_has_its_faces),
        cmocka_unit_test(round_faces_turn_with_the_point),
        cmocka_unit_test(refuses_with_words),
        cmocka_unit_test(what_is_just_allowed),
        cmocka_unit_test(relative_curvatures_of_crossed_cylinders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
