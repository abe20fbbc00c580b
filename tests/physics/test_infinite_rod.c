/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A mass on a semi-infinite rod (physics notes, section 5), by a finite one whose end hears nothing
 * of its length until 2 L/c: as long as the contact is over before that, length does not matter at
 * all, and only the truncation of the modes remains. */
#include "physics/support.h"
#include "unit/impact/toy_scene.h"

enum { MODES = 500 };

/* Rod with c = 1, Z = 1, so rho A = E A = 1; a mass m strikes its end at unit speed. The first
 * MODES modes take part, the residual flexibility stands for the others. */
static void build(struct toy *toy, double mass, struct contact_law law, double length)
{
    static double omega[MODES], shape[MODES];
    double held = 0.0;
    toy_init(toy, 1);
    for (int k = MODES; k-- > 0;) {
        omega[k] = (k + 1) * M_PI / length;
        shape[k] = sqrt(2.0 / length); /* M = rho A L = L */
        held += shape[k] * shape[k] / (omega[k] * omega[k]);
    }
    toy->w[0] = 1.0 / mass + 1.0 / length;
    toy->residual[0] = length / 3.0 - held;
    toy->gap_rate[0] = -1.0;
    toy->laws[0] = law;
    toy_add(toy, 1, MODES, omega, 0.0, shape);
}

/* What is left of the mass's speed, backward. */
static double rebound(double mass, struct contact_law law, double length, double *duration)
{
    struct toy toy;
    build(&toy, mass, law, length);
    struct impact_outcome outcome = toy_run(&toy, 1e-11, 100.0 * length);
    double ratio = outcome.tracks[0].impulse / mass - 1.0;
    *duration = outcome.tracks[0].list[0].end;
    assert_int_equal(outcome.tracks[0].count, 1);
    /* the reflection must not come back before the end */
    assert_true(*duration < 2.0 * length);
    toy_free(&toy);
    return ratio;
}

static void hertz_on_a_semi_infinite_rod(void **state)
{
    (void)state;
    static const struct {
        double lambda, expected;
    } cases[] = {{0.5, 0.436895}, {1.0, 0.184123}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        /* unit stiffness and speed: T = m^0.4 and lambda = m/T = m^0.6 with Z = 1 */
        double mass = pow(cases[i].lambda, 1.0 / 0.6);
        double duration;
        rebound(mass, contact_law_hertz(1.0), 20.0, &duration);
        double ratio = rebound(mass, contact_law_hertz(1.0), 0.55 * duration, &duration);
        /* the notes' digits; 500 modes and residual flexibility err by some 1e-9 */
        measured("rebound, lambda", ratio, cases[i].expected, 5e-7);
        double longer;
        /* nothing comes back in time: twice the length, the same rebound */
        measured("rebound, twice the length",
                 rebound(mass, contact_law_hertz(1.0), 1.1 * duration, &longer), ratio, 1e-8);
    }
}

static void linear_spring_on_a_semi_infinite_rod(void **state)
{
    (void)state;
    static const double ratios[] = {0.05, 0.2, 0.5, 0.8};
    for (size_t i = 0; i < COUNT(ratios); i++) {
        double zeta = ratios[i];
        double mass = 4.0 * zeta * zeta; /* zeta = sqrt(k m)/(2 Z) with k = Z = 1 */
        double root = sqrt(1.0 - zeta * zeta);
        double contact = M_PI * sqrt(mass) / root; /* half a period of the damped oscillator */
        double duration;
        double ratio = rebound(mass, contact_law_linear(1.0), 0.55 * contact, &duration);
        /* the first force is a ramp: what 500 modes and the residual flexibility miss of it falls
         * like N^-3, to some 1e-9 */
        measured("rebound, zeta", ratio, exp(-M_PI * zeta / root), 1e-8);
        measured_relative("duration", duration, contact, 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hertz_on_a_semi_infinite_rod),
        cmocka_unit_test(linear_spring_on_a_semi_infinite_rod),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
