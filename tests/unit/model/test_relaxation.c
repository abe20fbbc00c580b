/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/relaxation.c: moduli of complex frequencies, whose compliances add in
 * series. */
#include <complex.h>

#include "check.h"
#include "model/relaxation.h"

static complex double modulus(const struct relaxation *relaxation, double omega)
{
    complex double sum = 1.0;
    for (size_t i = 0; i < relaxation->count; i++)
        sum -= relaxation->share[i] / (1.0 + I * omega * relaxation->time[i]);
    return sum;
}

static void a_standard_solid_has_its_closed_form(void **state)
{
    (void)state;
    const struct relaxation solid = {1, {0.6}, {2.0}};
    /* the largest loss factor: share / (2 sqrt(1 - share)) at time omega = sqrt(1 - share) */
    double omega = sqrt(0.4) / 2.0;
    near_relative(relaxation_loss_factor(&solid, omega), 0.6 / (2.0 * sqrt(0.4)), 1e-14);
    near_relative(relaxation_storage(&solid, omega), 0.8 / 1.4, 1e-14);
    near_relative(relaxation_storage(&solid, 0.0), 0.4, 1e-14);
}

/* Share of the loss modulus at `at` times the frequency that the spectrum x^-power, of x = omega
 * time, has in the terms that the series leaves out, faster and slower than its ends: of
 * int x^-power x/(1 + x^2) dln x = pi/2 / cos(pi power/2). */
static double left_out(double power, double at)
{
    double fast = at * pow(10.0, -1.75), slow = at * pow(10.0, 2.25);
    return M_2_PI *
           (pow(fast, 1.0 - power) / (1.0 - power) + pow(slow, -1.0 - power) / (1.0 + power));
}

/* To rounding at its frequency, and of small ones around it, but for what the series leaves out
 * there, which at the frequency itself another power makes up for. */
static void a_constant_loss_factor_is_one(void **state)
{
    (void)state;
    for (double eta = 0.01; eta < 2.0; eta *= 1.69) {
        const double omega = 3e4;
        struct relaxation made = relaxation_constant(eta, omega);
        double sum = 0.0;
        for (size_t i = 0; i < made.count; i++) {
            assert_true(made.share[i] > 0.0 && (i == 0 || made.time[i] > made.time[i - 1]));
            sum += made.share[i];
        }
        assert_true(sum < 1.0);
        near_relative(relaxation_loss_factor(&made, omega), eta, 1e-12);
        if (eta > 0.5)
            continue;
        double power = M_2_PI * atan(eta);
        for (double at = 0.05; at < 6.0; at *= 1.3)
            measured("loss factor", relaxation_loss_factor(&made, at * omega) / eta, 1.0,
                     left_out(power, at) + left_out(power, 1.0));
        /* the modulus grows like a power of the frequency, d ln E / d ln omega = 2/pi eta */
        double grown = relaxation_storage(&made, omega) / relaxation_storage(&made, 0.1 * omega);
        measured("modulus", log(grown) / (power * M_LN10), 1.0,
                 left_out(power, 0.1) + left_out(power, 1.0));
    }
}

static void compliances_add_in_series(void **state)
{
    (void)state;
    const struct relaxation pairs[][2] = {
        {{2, {0.3, 0.5}, {0.1, 2.0}}, {1, {0.9}, {0.5}}},
        {{2, {0.3, 0.5}, {0.1, 2.0}}, {0, {0}, {0}}},
        {{1, {0.4}, {1.0}}, {1, {0.4}, {1.0}}},
        {{8, {.1, .1, .1, .1, .1, .1, .1, .1}, {1e-4, 1e-3, 1e-2, 1e-1, 1, 1e1, 1e2, 1e3}},
         {8,
          {.12, .12, .12, .12, .12, .12, .12, .12},
          {1e-4, 2e-3, 3e-2, 4e-1, 5, 6e1, 7e2, 8e3}}}};
    for (size_t p = 0; p < sizeof pairs / sizeof *pairs; p++)
        for (double part = 0.0; part <= 1.0; part += 0.25) {
            struct relaxation both = relaxation_in_series(&pairs[p][0], part, &pairs[p][1]);
            for (double omega = 1e-5; omega < 1e6; omega *= 7.0) {
                complex double sum = part / modulus(&pairs[p][0], omega) +
                                     (1.0 - part) / modulus(&pairs[p][1], omega);
                measured("modulus", cabs(modulus(&both, omega) * sum - 1.0), 0.0, 1e-9);
            }
        }
    /* two bodies of one material relax as it does */
    struct relaxation same = relaxation_in_series(&pairs[2][0], 0.3, &pairs[2][1]);
    assert_int_equal(same.count, 1);
    near_relative(same.share[0], 0.4, 1e-13);
    near_relative(same.time[0], 1.0, 1e-13);
}

/* The peak of one term is in closed form; of all frequencies from one beyond it on that is the
 * largest. */
static void the_largest_loss_is_found(void **state)
{
    (void)state;
    const struct relaxation solid = {1, {0.6}, {2.0}};
    const double omega = sqrt(0.4) / 2.0;
    near_relative(relaxation_peak_loss(&solid, 0.0), 0.6 / (2.0 * sqrt(0.4)), 0.01);
    near_relative(relaxation_peak_loss(&solid, 0.1 * omega), 0.6 / (2.0 * sqrt(0.4)), 0.01);
    near(relaxation_peak_loss(&solid, 30.0), relaxation_loss_factor(&solid, 30.0), 1e-15);
    const struct relaxation none = {0};
    near(relaxation_peak_loss(&none, 0.0), 0.0, 0.0);
}

/* Terms in any order, and one time twice; what is far from a frequency is a spring there. */
static void what_is_far_away_is_a_spring(void **state)
{
    (void)state;
    struct relaxation all = {0};
    relaxation_add(&all, 0.1, 3e-3);
    relaxation_add(&all, 0.2, 1e-12);
    relaxation_add(&all, 0.3, 1e9);
    relaxation_add(&all, 0.05, 3e-3);
    assert_int_equal(all.count, 3);
    assert_true(all.time[0] == 1e-12 && all.time[1] == 3e-3 && all.time[2] == 1e9);
    near(all.share[1], 0.15, 1e-16);
    double stiffness, omega = 1e3;
    struct relaxation near_by = relaxation_near(&all, omega, &stiffness);
    assert_int_equal(near_by.count, 1);
    near(stiffness, 0.8, 1e-15);
    near(stiffness * relaxation_storage(&near_by, omega), relaxation_storage(&all, omega), 1e-12);
    near(relaxation_loss_factor(&near_by, omega), relaxation_loss_factor(&all, omega), 1e-8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_standard_solid_has_its_closed_form),
        cmocka_unit_test(a_constant_loss_factor_is_one),
        cmocka_unit_test(the_largest_loss_is_found),
        cmocka_unit_test(what_is_far_away_is_a_spring),
        cmocka_unit_test(compliances_add_in_series),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
