/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors the rules of tests/reference/spatial/moving.c on one oscillator u'' + w^2 u = f: its
 * orders against the exact motion under a force that rises, energy, and what is too stiff for the
 * step. */
#include "check.h"
#include "spatial/moving.h"

static void step(const struct rational *rule, double h, double stiffness, const double force[2],
                 double state[2])
{
    double complex length = rule->pole * h, s = 1.0 / (length * length);
    double complex p =
        (s * (state[0] + length * state[1]) + rule->start * force[0] + rule->end * force[1]) /
        (stiffness + s);
    double complex q = (p - state[0]) / length;
    state[0] = rule->keep * state[0] + 2.0 * creal(rule->weight * p);
    state[1] = rule->keep * state[1] + 2.0 * creal(rule->weight * q);
}

/* error in position and velocity over w at t = 1 from (1, 0) with f = t, w = 3 */
static double error_of(enum rational_rule which, int steps)
{
    struct rational rule = rational_make(which);
    double w = 3.0, h = 1.0 / steps, state[2] = {1.0, 0.0};
    for (int i = 0; i < steps; i++)
        step(&rule, h, w * w, (const double[2]){i * h, (i + 1) * h}, state);
    double exact[2] = {cos(w) + (1.0 - sin(w) / w) / (w * w),
                       -w * sin(w) + (1.0 - cos(w)) / (w * w)};
    return hypot(state[0] - exact[0], (state[1] - exact[1]) / w);
}

static void has_its_order(void **state)
{
    (void)state;
    /* halving the step: 2^3, 2^4, with what the next order adds at 1/40 */
    near(error_of(RATIONAL_RADAU, 20) / error_of(RATIONAL_RADAU, 40), 8.0, 0.6);
    near(error_of(RATIONAL_GAUSS, 20) / error_of(RATIONAL_GAUSS, 40), 16.0, 0.2);
}

static void keeps_energy_or_follows(void **state)
{
    (void)state;
    /* Gauss: no energy is lost, whatever the step */
    struct rational rule = rational_make(RATIONAL_GAUSS);
    double motion[2] = {1.0, 0.5};
    for (int i = 0; i < 1000; i++)
        step(&rule, 0.7, 9.0, (const double[2]){0.0, 0.0}, motion);
    near(9.0 * motion[0] * motion[0] + motion[1] * motion[1], 9.25, 1e-11);
    /* Radau: what is very stiff is where the force at the step's end holds it */
    rule = rational_make(RATIONAL_RADAU);
    double stiff[2] = {1.0, 0.0};
    step(&rule, 1.0, 1e12, (const double[2]){5.0, 3e12}, stiff);
    near(stiff[0], 3.0, 1e-5);
    /* a free mass under a rising force: v = h f / 2, exactly */
    double free_mass[2] = {0.0, 0.0};
    step(&rule, 0.25, 0.0, (const double[2]){0.0, 8.0}, free_mass);
    near(free_mass[1], 1.0, 1e-14);
    near(free_mass[0], 8.0 * 0.25 * 0.25 / 6.0, 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(has_its_order),
        cmocka_unit_test(keeps_energy_or_follows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
