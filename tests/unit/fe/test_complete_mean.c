/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/complete_converge.c: sums and balances hold for a mean as for what it is of.
 */
#include "check.h"
#include "fe/complete_converge.h"

static struct complete_result known(double impulse)
{
    struct complete_result result = {
        .impulse = impulse,
        .restitution = impulse - 1.0,
        .peak_force = 100.0 * impulse,
        .momentum_error = 1e-12 * impulse,
        .mass = {0.1, 0.8},
        .energy = {.available = 5.0, .rebound = impulse, .vibration = 1.0, .plastic = 2.0},
        .sub_impacts = 2,
        .end = PERCUSS_END_SEPARATED,
        .elements = (size_t)(1000.0 * impulse),
    };
    result.energy.closure = 2.0 - impulse;
    result.sub_impact[0].impulse = 0.75 * impulse;
    result.sub_impact[1].impulse = 0.25 * impulse;
    return result;
}

static void sums_and_balances_hold(void **unused)
{
    (void)unused;
    const struct complete_result results[] = {known(1.4), known(1.5), known(1.9)};
    const double weights[] = {0.25, 0.5, 0.25};
    struct complete_result mean;
    assert_true(complete_mean(results, weights, 3, &mean));
    measured("impulse", mean.impulse, 1.575, 1e-15);
    measured("restitution", mean.restitution, 0.575, 1e-15);
    measured("sub-impacts", mean.sub_impact[0].impulse + mean.sub_impact[1].impulse, mean.impulse,
             1e-15);
    const struct complete_energy *energy = &mean.energy;
    measured("balance",
             energy->available - energy->rebound - energy->vibration - energy->plastic -
                 energy->closure,
             0.0, 1e-15);
    measured("mass", mean.mass[1], 0.8, 0.0);
    assert_int_equal(mean.elements, 1500);
    assert_int_equal(mean.sub_impacts, 2);
    measured("worst", mean.momentum_error, 1.9e-12, 1e-25);
}

static void other_courses_have_no_mean(void **unused)
{
    (void)unused;
    struct complete_result results[] = {known(1.4), known(1.5)};
    const double weights[] = {0.5, 0.5};
    struct complete_result mean;
    results[1].sub_impacts = 1;
    assert_false(complete_mean(results, weights, 2, &mean));
    results[1] = known(1.5);
    results[1].end = PERCUSS_END_HORIZON;
    assert_false(complete_mean(results, weights, 2, &mean));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_and_balances_hold),
        cmocka_unit_test(other_courses_have_no_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
