/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/contact/hertz.c: stiffness, ellipse and pressure against mpmath and closed forms,
 * from the circle to the line. */
#include "check.h"
#include "contact/hertz.h"

static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct material aluminium = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0};

static void combines_moduli(void **state)
{
    (void)state;
    near_relative(hertz_effective_modulus(&steel, &aluminium),
                  1.0 / ((1.0 - 0.09) / 210e9 + (1.0 - 0.1089) / 70e9), 1e-15);
    near_relative(hertz_effective_modulus(&steel, &steel), 0.5 * 210e9 / (1.0 - 0.09), 1e-15);
}

/* B/A, b/a and k for E* = 1, A = 1, from Johnson's formulas with mpmath's K and E at 50 digits, the
 * axis ratio by bisection. */
static const double digits[][3] = {
    {1, 1.0, 0.94280904158206337},
    {1.000000000001, 0.99999999999933333, 0.94280904158182766},
    {1.000001, 0.99999933333388889, 0.94280880587996993},
    {1.001, 0.99933388839859372, 0.94257350614251346},
    {1.5, 0.7632987856063925, 0.85484036746084685},
    {2, 0.6305957014280997, 0.80072747555058409},
    {7.3, 0.2713532385874621, 0.62030520104433075},
    {100, 0.054984018057118764, 0.42785128688386969},
    {1e4, 0.0041248573583856217, 0.28153806191870622},
    {999999, 0.0003459502224325847, 0.21156503527907429},
};

static void matches_mpmath_from_circle_to_line(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof digits / sizeof *digits; i++) {
        struct hertz_contact contact = hertz_contact_make(1.0, 1.0, digits[i][0]);
        /* k is stationary-like in the axis ratio: both to some roundings */
        near_relative(contact.axis_ratio, digits[i][1], 2e-14);
        near_relative(contact.stiffness, digits[i][2], 1e-14);
        /* scales with E* and 1/sqrt(A) */
        contact = hertz_contact_make(3e10, 25.0, 25.0 * digits[i][0]);
        near_relative(contact.stiffness, 3e10 / 5.0 * digits[i][2], 1e-13);
    }
}

static void knows_the_sphere_and_the_paper_s_beam(void **state)
{
    (void)state;
    double modulus = hertz_effective_modulus(&steel, &aluminium);
    struct hertz_contact sphere = hertz_contact_make(modulus, 0.5 / 0.015, 0.5 / 0.015);
    near_relative(sphere.stiffness, 4.0 / 3.0 * modulus * sqrt(0.015), 1e-15);
    assert_true(sphere.axis_ratio == 1.0);
    /* the notes: R1 15 mm, R2 6 mm; their six digits */
    near_relative(hertz_contact_make(modulus, 0.5 / 0.015, 0.5 / 0.006).stiffness, 7.74365e9, 6e-7);
}

/* Rounding may turn equal curvatures around: that is a circle still. */
static void survives_rounding_at_the_circle(void **state)
{
    (void)state;
    double circle = hertz_contact_make(1.0, 1.0, 1.0).stiffness;
    for (int ulps = -4; ulps <= 4; ulps++) {
        double b = 1.0 + ulps * 0x1p-52;
        near_relative(hertz_contact_make(1.0, 1.0, b).stiffness, circle, 1e-15);
    }
}

static void falls_steadily_with_the_ratio(void **state)
{
    (void)state;
    double before = INFINITY;
    for (double ratio = 1.0; ratio < 1e6; ratio *= 1.013) {
        struct hertz_contact contact = hertz_contact_make(1.0, 1.0, ratio);
        assert_true(contact.stiffness < before);
        assert_true(contact.axis_ratio > 0.0 && contact.axis_ratio <= 1.0);
        before = contact.stiffness;
    }
}

/* a = sqrt(R d) and p0 = 2 E* sqrt(d/R)/pi on the sphere; in general the work done against the
 * pressure 2/3 p0 pi a b is the force. */
static void ellipse_and_pressure(void **state)
{
    (void)state;
    struct hertz_contact sphere = hertz_contact_make(4e10, 50.0, 50.0); /* R = 10 mm */
    double force = 100.0;
    double depth = cbrt(force / sphere.stiffness) * cbrt(force / sphere.stiffness);
    double axes[2];
    hertz_ellipse(&sphere, force, axes);
    near_relative(axes[0], sqrt(0.01 * depth), 1e-14);
    near_relative(axes[1], axes[0], 1e-15);
    near_relative(hertz_peak_pressure(&sphere, force), 2.0 * 4e10 / M_PI * sqrt(depth / 0.01),
                  1e-14);
    for (size_t i = 0; i < sizeof digits / sizeof *digits; i++) {
        struct hertz_contact contact = hertz_contact_make(4e10, 3.0, 3.0 * digits[i][0]);
        hertz_ellipse(&contact, force, axes);
        near_relative(axes[1] / axes[0], digits[i][1], 2e-14);
        near_relative(2.0 / 3.0 * M_PI * axes[0] * axes[1] * hertz_peak_pressure(&contact, force),
                      force, 1e-14);
        /* eight times the force, twice the pressure */
        near_relative(hertz_peak_pressure(&contact, 8.0 * force),
                      2.0 * hertz_peak_pressure(&contact, force), 1e-14);
    }
    assert_true(hertz_peak_pressure(&sphere, 0.0) == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(combines_moduli),
        cmocka_unit_test(matches_mpmath_from_circle_to_line),
        cmocka_unit_test(knows_the_sphere_and_the_paper_s_beam),
        cmocka_unit_test(survives_rounding_at_the_circle),
        cmocka_unit_test(falls_steadily_with_the_ratio),
        cmocka_unit_test(ellipse_and_pressure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
