/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/beam_statics.c: the field of a bent bar. Its compliance is checked against
 * meshes (physics/mesh/test_beam_sides). */
#include "check.h"
#include "model/bar.h"

static const double NU = 0.33;

static struct body bar(double radius, double width, double height)
{
    struct fault fault;
    struct body body = {.kind = &beam_kind,
                        .material = {"aluminium", 70e9, NU, 2700.0, INFINITY, 0.0},
                        .radius = radius,
                        .width = width,
                        .height = height,
                        .length = 0.2,
                        .tip_radius = INFINITY};
    assert_int_equal(body_complete(&body, &fault), PERCUSS_OK);
    return body;
}

static double curvature(const struct body *body, int plane, double y, double z, double n_y,
                        double n_z)
{
    return beam_side_load(body, plane, (double[3]){0.0, y, z}, (double[3]){0.0, n_y, n_z})
        .curvature;
}

/* nu/2 (z^2 - y^2 - m) along the deflection and nu y z across it, in both planes. */
static void sections_deform(void **state)
{
    (void)state;
    struct body square = bar(0.0, 0.008, 0.008), flat = bar(0.0, 0.016, 0.008);
    near(curvature(&square, 1, 0.0, 0.004, 0.0, 1.0), NU * 8e-6, 1e-20);
    near(curvature(&square, 0, 0.004, 0.0, 1.0, 0.0), NU * 8e-6, 1e-20);
    near(curvature(&square, 1, 0.004, 0.004, 0.0, 1.0), 0.0, 1e-20);
    near(curvature(&square, 1, 0.003, 0.004, 1.0, 0.0), NU * 12e-6, 1e-20);
    near(curvature(&square, 0, 0.003, 0.004, 0.0, 1.0), NU * 12e-6, 1e-20);
    /* of a section twice as broad the mean is (h^2 - w^2)/12 = -16e-6 m^2 */
    near(curvature(&flat, 1, 0.0, 0.004, 0.0, 1.0), NU * 16e-6, 1e-20);
    near(curvature(&flat, 0, 0.008, 0.0, 1.0, 0.0), NU * 24e-6, 1e-20);
    near(curvature(&flat, 1, 0.008, 0.0, 0.0, 1.0), -NU * 24e-6, 1e-20);
}

/* The mean over a section of what bending adds to w is zero. */
static void the_mean_is_w(void **state)
{
    (void)state;
    struct body flat = bar(0.0, 0.016, 0.008);
    double sum = 0.0;
    for (int i = 0; i < 200; i++)
        for (int k = 0; k < 100; k++)
            sum += curvature(&flat, 1, 0.016 * ((i + 0.5) / 200.0 - 0.5),
                             0.008 * ((k + 0.5) / 100.0 - 0.5), 0.0, 1.0);
    near(sum / 2e4, 0.0, 1e-4 * NU * 16e-6);
}

/* Round about, the force is along the deflection; the two planes share it as they share the force.
 * Textbook beams keep their sections. */
static void a_round_bar_is_alike_all_round(void **state)
{
    (void)state;
    struct body round_bar = bar(0.01, 0.0, 0.0);
    for (double turn = 0.0; turn < 6.0; turn += 0.7) {
        double s = sin(turn), c = cos(turn);
        near(curvature(&round_bar, 1, 0.01 * s, 0.01 * c, s, c), 0.5 * NU * 1e-4 * c, 1e-19);
        near(curvature(&round_bar, 0, 0.01 * s, 0.01 * c, s, c), 0.5 * NU * 1e-4 * s, 1e-19);
    }
    round_bar.theory = THEORY_EULER_BERNOULLI;
    near(curvature(&round_bar, 1, 0.0, 0.01, 0.0, 1.0), 0.0, 0.0);
}

/* Times E and the depth, whichever side is hit; a face that is hit at its middle gives way less
 * than a half-space, one near an edge more. */
static void sides_give_way(void **state)
{
    (void)state;
    struct body flat = bar(0.0, 0.016, 0.008), high = bar(0.0, 0.008, 0.016);
    const double top[3] = {0.0, 0.0, 1.0}, side[3] = {0.0, -1.0, 0.0};
    double unit = 70e9 * 0.008;
    double middle = beam_side_compliance(&flat, (double[3]){0.02, 0.0, 0.004}, top);
    near(unit * middle, -0.61, 0.02);
    near(beam_side_compliance(&high, (double[3]){-0.05, -0.004, 0.0}, side), middle,
         1e-12 * fabs(middle));
    assert_true(beam_side_compliance(&flat, (double[3]){0.0, 0.0075, 0.004}, top) > 0.5 * middle);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sections_deform),
        cmocka_unit_test(the_mean_is_w),
        cmocka_unit_test(a_round_bar_is_alike_all_round),
        cmocka_unit_test(sides_give_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
