/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/contact/strain_rate.c. */
#include "check.h"
#include "contact/law_closed_form.h"
#include "contact/plastic.h"
#include "contact/strain_rate.h"

static const struct material ball = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct yield_rate none, mild_steel = {.reference = 40.4, .exponent = 5.0},
                                     steep = {.reference = 1.0, .exponent = 1.0};
static const double RADIUS = 0.005;

static double rate_on(const struct material *plane, const struct yield_rate *stated,
                      const struct strain_rate_blow *blow, double factors[2])
{
    struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(&ball, plane), 0.5 / RADIUS, 0.5 / RADIUS);
    return strain_rate_of(&hertz, (const struct material *const[]){&ball, plane},
                          (const struct yield_rate *const[]){&none, stated}, blow, factors);
}

/* A contact that stays elastic: a^2 = R d, and 2/5 k d^(5/2) is the work. */
static void below_yield_it_is_that_of_hertz(void **state)
{
    (void)state;
    struct material hard = {"hard", 210e9, 0.30, 7800.0, 20e9, 0.0};
    struct strain_rate_blow blow = {.speed = 0.3, .work = 1e-4};
    double factors[2];
    double k = 4.0 / 3.0 * hertz_effective_modulus(&ball, &hard) * sqrt(RADIUS);
    double d = pow(2.5 * blow.work / k, 0.4);
    near_relative(rate_on(&hard, &none, &blow, factors),
                  0.2 * sqrt(d / RADIUS) * blow.speed / (M_PI_2 * d), 1e-8);
    assert_true(factors[0] == 1.0 && factors[1] == 1.0);
}

/* The factor is that of the rate, and the rate that of a contact whose yield is as much larger:
 * the fixed point, also where the stress grows as fast as the rate. */
static void the_rate_is_that_of_the_raised_yield(void **state)
{
    (void)state;
    const struct yield_rate *stated[] = {&mild_steel, &steep};
    struct material plane = {"mild", 210e9, 0.30, 7800.0, 25e6, 0.0};
    for (size_t i = 0; i < COUNT(stated); i++)
        for (double speed = 0.01; speed < 10.0; speed *= 4.0) {
            struct strain_rate_blow blow = {.speed = speed, .work = 0.002 * speed * speed};
            struct material raised = plane;
            double factors[2], other[2];
            double rate = rate_on(&plane, stated[i], &blow, factors);
            near_relative(factors[1],
                          fmin(yield_rate_factor(stated[i], rate), plane.young / plane.yield),
                          1e-14);
            assert_true(factors[0] == 1.0 && factors[1] > 1.0);
            raised.yield *= factors[1];
            near_relative(rate_on(&raised, &none, &blow, other), rate, 1e-8);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(below_yield_it_is_that_of_hertz),
        cmocka_unit_test(the_rate_is_that_of_the_raised_yield),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
