/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the models may be wrong by as an input: a distribution where a sequence amplifies it, nearly
 * one number where it does not, and both as wide as a single answer states. */
#include "physics/ensemble_lab.h"

static struct solve_result result;

struct spread {
    double deviation;
    double covered; /* share of the samples within what the single answer states */
};

static struct spread spread_at(double speed)
{
    enum { SAMPLES = 400 };
    struct ensemble_lab e;
    struct spread spread = {0.0, 0.0};
    ensemble_lab_open(&e);
    e.request.bodies[0].velocity[2] = -speed;
    lab_solve(e.lab, &e.request, &result);
    e.spec.samples = SAMPLES;
    e.spec.input_count = 4;
    e.inputs[0] = uncertain(INPUT_SPEED, 0, DISTRIBUTION_IS_CONSTANT, speed, 0.0);
    e.inputs[1] = uncertain(INPUT_MODEL_FORCE, 0, DISTRIBUTION_IS_NORMAL, 0.0, 1.0);
    e.inputs[2] = uncertain(INPUT_MODEL_COMPLIANCE, 0, DISTRIBUTION_IS_NORMAL, 0.0, 1.0);
    e.inputs[3] = uncertain(INPUT_MODEL_YIELD, 0, DISTRIBUTION_IS_NORMAL, 0.0, 1.0);
    ensemble_lab_run(&e, false);
    for (size_t i = 0; i < SAMPLES; i++) {
        assert_int_equal(e.samples[i].status, PERCUSS_OK);
        double off = fabs(e.samples[i].restitution - result.contacts[0].restitution);
        spread.covered += off <= result.restitution_total;
        spread.deviation += off * off;
    }
    spread.covered /= SAMPLES;
    spread.deviation = sqrt(spread.deviation / SAMPLES);
    printf("%g m/s: e = %.4f +- %.4f, deviation %.4f, covered %.3f\n", speed,
           result.contacts[0].restitution, result.restitution_total, spread.deviation,
           spread.covered);
    ensemble_lab_close(&e);
    return spread;
}

/* 0.95 less three standard deviations of 400 samples, 0.011 each. */
static void a_chaotic_case_is_a_distribution(void **state)
{
    (void)state;
    struct spread calm = spread_at(0.2);
    struct spread wild = spread_at(0.287);
    assert_true(calm.covered > 0.917 && wild.covered > 0.917);
    assert_true(calm.deviation < 0.01 && wild.deviation > 0.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_chaotic_case_is_a_distribution)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
