/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/plate.c: the limits of large plates and long bars in closed form. */
#include "model/plate.h"

#include "check.h"

static const struct material steel = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};

static double share_at(double height, double a, double b, double x, double duration)
{
    struct plate plate = {.material = &steel,
                          .height = height,
                          .sides = {a, b},
                          .at = {x, 0.0},
                          .mass = steel.density * height * a * b};
    return plate_share(&plate, 0.03, duration);
}

/* Force over speed of an infinite plate is 8 sqrt(D rho h) (Zener 1941): with half a sine of the
 * impulse 2 m v a share pi^2 m/(Z T) of m v^2/2 goes. Whatever the size, and where it is hit. */
static void an_infinite_plate(void **state)
{
    (void)state;
    double height = 0.005, duration = 100e-6;
    double stiffness = 210e9 * height * height * height / (12.0 * (1.0 - 0.09));
    double impedance = 8.0 * sqrt(stiffness * 7800.0 * height);
    double zener = M_PI * M_PI * 0.03 / (impedance * duration);
    near_relative(share_at(height, 0.4, 0.4, 0.0, duration), zener, 0.1);
    near_relative(share_at(height, 2.0, 3.0, 0.3, duration), zener, 0.1);
    /* at an edge 8/3.5 times that; products of bars say up to twice as much */
    double edge = share_at(height, 2.0, 3.0, 1.0, duration) / zener;
    assert_true(edge > 8.0 / 3.5 && edge < 2.0 * 8.0 / 3.5);
}

/* A long thin bar takes Re(1/Z) = 1/(4 rho A sqrt(b omega)), omega = b k^2, of the spectrum's
 * square: (2 m v)^2/pi times the integral of cos^2(pi s/2)/(1 - s^2)^2/sqrt(s), which is 1.98. */
static void an_infinite_bar(void **state)
{
    (void)state;
    double height = 0.002, width = 0.0005, duration = 100e-6;
    double bending = height * sqrt(210e9 / 7800.0 / (12.0 * (1.0 - 0.09)));
    double unit = 4.0 * 7800.0 * height * width * sqrt(bending * M_PI / duration);
    double known = 4.0 * 0.03 * 1.98 * 2.0 / duration / unit;
    near_relative(share_at(height, 1.0, width, 0.0, duration), known, 0.15);
}

/* Slow contacts find next to nothing, slower ones less. */
static void a_compact_body(void **state)
{
    (void)state;
    double once = share_at(0.04, 0.04, 0.04, 0.0, 70e-6);
    assert_true(once > 0.0 && once < 1e-3);
    assert_true(share_at(0.04, 0.04, 0.04, 0.0, 90e-6) < once);
    assert_true(share_at(0.04, 0.04, 0.04, 0.0, 1e-3) == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_infinite_plate),
        cmocka_unit_test(an_infinite_bar),
        cmocka_unit_test(a_compact_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
