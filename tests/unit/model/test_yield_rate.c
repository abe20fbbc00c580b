/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/yield_rate.c. */
#include "check.h"
#include "model/yield_rate.h"

static const struct yield_rate none, mild_steel = {.reference = 40.4, .exponent = 5.0},
                                     alloy = {.reference = 1.0, .coefficient = 0.014};

static void factors_are_the_published_ones(void **state)
{
    (void)state;
    near_relative(yield_rate_factor(&none, 1e6), 1.0, 0.0);
    near_relative(yield_rate_factor(&mild_steel, 0.0), 1.0, 0.0);
    near_relative(yield_rate_factor(&mild_steel, 40.4), 2.0, 1e-15);
    near_relative(yield_rate_factor(&mild_steel, 40.4 * 32.0), 3.0, 1e-15);
    near_relative(yield_rate_factor(&alloy, exp(10.0)), 1.14, 1e-15);
    /* a slow test is no weaker than a very slow one */
    near_relative(yield_rate_factor(&alloy, 1e-6), 1.0, 0.0);
    near_relative(yield_rate_factor(&alloy, 0.0), 1.0, 0.0);
}

static void rates_are_those_of_the_factors(void **state)
{
    (void)state;
    const struct yield_rate *laws[] = {&mild_steel, &alloy};
    for (size_t i = 0; i < COUNT(laws); i++)
        for (double raise = 0.05; raise < 0.5; raise *= 2.0) {
            double slope, higher, lower, unused;
            near_relative(yield_rate_factor(laws[i], yield_rate_at(laws[i], raise, &slope)),
                          1.0 + raise, 1e-14);
            higher = yield_rate_at(laws[i], raise * (1.0 + 1e-6), &unused);
            lower = yield_rate_at(laws[i], raise * (1.0 - 1e-6), &unused);
            near_relative(slope, (higher - lower) / (2e-6 * raise), 1e-8);
            /* d ln factor / d ln rate by the inverse */
            double rate = yield_rate_at(laws[i], raise, &slope);
            near_relative(yield_rate_sensitivity(laws[i], rate), rate / slope / (1.0 + raise),
                          1e-12);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_are_the_published_ones),
        cmocka_unit_test(rates_are_those_of_the_factors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
