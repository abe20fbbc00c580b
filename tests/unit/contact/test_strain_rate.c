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
    struct strain_rate found[2];
    strain_rate_of(&hertz, (const struct material *const[]){&ball, plane},
                   (const struct yield_rate *const[]){&none, stated}, blow, found);
    assert_true(found[0].rate == 0.0);
    factors[0] = found[0].factor;
    factors[1] = found[1].factor;
    return found[1].rate;
}

/* A contact that stays elastic: a^2 = R d, 2/5 k d^(5/2) is the work, and two thirds of d would
 * spring back along the tangent. */
static void below_yield_it_is_that_of_hertz(void **state)
{
    (void)state;
    struct material hard = {"hard", 210e9, 0.30, 7800.0, 20e9, 0.0};
    struct strain_rate_blow blow = {.speed = 0.3, .work = 1e-4};
    const struct yield_rate log_law = {.reference = 1e-3, .coefficient = 0.014};
    double factors[2];
    double k = 4.0 / 3.0 * hertz_effective_modulus(&ball, &hard) * sqrt(RADIUS);
    double d = pow(2.5 * blow.work / k, 0.4);
    double rate = rate_on(&hard, &log_law, &blow, factors);
    near_relative(rate,
                  0.35 * pow(0.014 / factors[1] * 2.0 / 3.0, 0.8) * blow.speed / sqrt(RADIUS * d),
                  1e-8);
    near_relative(factors[1], 1.0 + 0.014 * log(rate / 1e-3), 1e-14);
    assert_true(rate_on(&hard, &none, &blow, factors) == 0.0 && factors[1] == 1.0);
}

/* The factor is that of the rate, and the rate that of a contact with the yield stress so raised:
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
            double factors[2];
            double rate = rate_on(&plane, stated[i], &blow, factors);
            near_relative(factors[1],
                          fmin(yield_rate_factor(stated[i], rate), plane.young / plane.yield),
                          1e-14);
            assert_true(factors[0] == 1.0 && factors[1] > 1.0);
            raised.yield *= factors[1];
            struct hertz_contact hertz = hertz_contact_make(hertz_effective_modulus(&ball, &plane),
                                                            0.5 / RADIUS, 0.5 / RADIUS);
            struct contact_law law = contact_law_closed_form(&hertz, &ball, &raised);
            double depth = contact_law_depth(&law, blow.work), radius, springs = 2.0 / 3.0;
            radius = law.operations->curve->radius(&law, depth);
            if (depth > law.operations->curve->yield(&law)) {
                /* by the fall of the force along the branch */
                law = contact_law_after(&law, depth);
                double stiffness, top = depth - law.history.dent;
                law.operations->force(&law, top * (1.0 - 1e-9), &stiffness);
                springs = law.history.max_force / stiffness / depth;
            }
            near_relative(rate,
                          0.35 * pow(yield_rate_sensitivity(stated[i], rate) * springs, 0.8) *
                              speed / radius,
                          1e-6);
        }
}

/* Of two bodies each has the rate of its own sensitivity. */
static void each_body_has_its_own(void **state)
{
    (void)state;
    struct material soft = {"soft", 210e9, 0.30, 7800.0, 250e6, 0.0}, other = soft;
    const struct yield_rate alloy = {.reference = 1.0, .coefficient = 0.014};
    struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(&soft, &other), 0.5 / RADIUS, 0.5 / RADIUS);
    struct strain_rate found[2];
    strain_rate_of(&hertz, (const struct material *const[]){&soft, &other},
                   (const struct yield_rate *const[]){&mild_steel, &alloy},
                   &(struct strain_rate_blow){0.5, 0.002}, found);
    double ratio = yield_rate_sensitivity(&mild_steel, found[0].rate) /
                   yield_rate_sensitivity(&alloy, found[1].rate);
    assert_true(ratio > 3.0);
    near_relative(found[0].rate / found[1].rate, pow(ratio, 0.8), 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(below_yield_it_is_that_of_hertz),
        cmocka_unit_test(the_rate_is_that_of_the_raised_yield),
        cmocka_unit_test(each_body_has_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
