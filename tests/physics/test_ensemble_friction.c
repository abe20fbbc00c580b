/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Ensembles in which the coefficient of friction is uncertain. A ball that slides throughout on a
 * rigid wall has the tangential impulse mu P, P = 2 m v: mean, deviation and indices are known in
 * closed form. */
#include "physics/ensemble_lab.h"

static const double RADIUS = 0.01;
static const double SAMPLES = 1024;

/* A ball comes to the wall at 1 m/s and slides along the first tangent at `slip` m/s. */
static void open(struct ensemble_lab *e, double slip)
{
    memset(e, 0, sizeof *e);
    e->lab = lab_create();
    lab_add(e->lab, "ball", make_sphere(STEEL, RADIUS));
    lab_add(e->lab, "wall", rigid_wall());
    e->request = strike(sphere_spot("ball", RADIUS), wall_spot("wall"), 1.0);
    e->request.bodies[0].velocity[0] = slip;
    e->request.contacts[0].tangent[0] = 1.0;
    e->spec = (struct ensemble_spec){.catalogue = &e->lab->set,
                                     .request = &e->request,
                                     .input_count = 1,
                                     .inputs = e->inputs,
                                     .samples = (uint64_t)SAMPLES,
                                     .sampling = SAMPLING_IS_LATIN_HYPERCUBE,
                                     .seed = 1};
}

static double normal_impulse(void)
{
    return 2.0 * STEEL.density * 4.0 / 3.0 * M_PI * RADIUS * RADIUS * RADIUS;
}

static const struct report_quantity *quantity(const struct ensemble_lab *e, const char *name)
{
    for (size_t q = 0; q < e->report.quantity_count; q++)
        if (strcmp(e->report.quantities[q].name, name) == 0)
            return &e->report.quantities[q];
    fail_msg("no %s", name);
    return NULL;
}

/* Slides from psi = 4.76 on: here at least 8. */
static void slides(void **state)
{
    (void)state;
    struct ensemble_lab e;
    double p = normal_impulse(), low = 0.05, high = 0.1;
    open(&e, 1.0);
    e.inputs[0] = uncertain(INPUT_FRICTION, 0, DISTRIBUTION_IS_UNIFORM, low, high);
    ensemble_lab_run(&e, true);
    for (uint64_t i = 0; i < e.ensemble.count; i++) {
        double mu;
        ensemble_inputs(&e.ensemble, i, &mu);
        measured("impulse", e.samples[i].tangential[0] / p, -mu * e.samples[i].impulse / p, 1e-12);
    }
    const struct moments *t = &quantity(&e, "impulse_tangential_1")->moments;
    measured("mean", t->mean / p, -0.5 * (low + high), 1e-5);
    measured("deviation", t->deviation / p, (high - low) / sqrt(12.0), 2e-5);
    /* the slip loses 3.5 times the impulse over the mass: 7 mu v */
    const struct moments *back = &quantity(&e, "tangential_restitution")->moments;
    measured("tangential restitution", back->mean, -1.0 + 7.0 * 0.075, 1e-4);
    measured("its deviation", back->deviation, 7.0 * (high - low) / sqrt(12.0), 2e-4);
    measured("kinematic", quantity(&e, "restitution_kinematic")->moments.mean, 1.0, 1e-4);
    /* the other component has no scatter; e has none either */
    assert_true(quantity(&e, "impulse_tangential_2")->moments.highest == 0.0);
    assert_int_equal(e.report.tangential_count, 1);
    assert_string_equal(e.report.tangential[0].quantity, "impulse_tangential_1");
    assert_true(e.report.tangential[0].indices.first_order > 0.99);
    assert_true(isnan(e.report.inputs[0].indices.first_order));
    assert_true(e.report.verification.largest < 1e-3);
    ensemble_lab_close(&e);
}

/* Of a contact that sticks the coefficient is no cause: psi is 0.01, its rim alone slides. */
static void sticks(void **state)
{
    (void)state;
    struct ensemble_lab e;
    open(&e, 0.1);
    e.request.options.tolerance = 1e-4;
    e.spec.samples = 64;
    e.inputs[0] = uncertain(INPUT_FRICTION, 0, DISTRIBUTION_IS_UNIFORM, 6.0, 10.0);
    ensemble_lab_run(&e, false);
    const struct moments *t = &quantity(&e, "impulse_tangential_1")->moments;
    measured("scatter", t->deviation / -t->mean, 0.0, 1e-3);
    /* rebounds as a contact without slip: 0.2317 of the slip */
    measured("tangential restitution", quantity(&e, "tangential_restitution")->moments.mean,
             -0.2317, 2e-3);
    ensemble_lab_close(&e);
}

/* P_t = 2 m mu v: of independent factors a and b the indices are known. */
static void indices_of_a_product(void **state)
{
    (void)state;
    struct ensemble_lab e;
    double a = 0.075, b = 1.0, va = 0.05 * 0.05 / 12.0, vb = 0.6 * 0.6 / 12.0;
    double all = va * b * b + vb * a * a + va * vb;
    open(&e, 1.0);
    e.spec.samples = 4096;
    e.spec.input_count = 2;
    e.inputs[0] = uncertain(INPUT_FRICTION, 0, DISTRIBUTION_IS_UNIFORM, 0.05, 0.1);
    e.inputs[1] = uncertain(INPUT_SPEED, 0, DISTRIBUTION_IS_UNIFORM, 0.7, 1.3);
    ensemble_lab_run(&e, true);
    assert_int_equal(e.report.tangential_count, 2);
    const struct indices *mu = &e.report.tangential[0].indices;
    const struct indices *speed = &e.report.tangential[1].indices;
    measured("by mu alone", mu->first_order, va * b * b / all, 0.015);
    measured("by speed alone", speed->first_order, vb * a * a / all, 0.015);
    assert_true(mu->first_bounds.low < va * b * b / all &&
                va * b * b / all < mu->first_bounds.high);
    /* all that neither explains by itself is their interaction */
    measured("sum", mu->first_order + speed->total, 1.0, 0.015);
    measured("left of mu", mu->total, 1.0 - vb * a * a / all, 0.01);
    measured("left of speed", speed->total, 1.0 - va * b * b / all, 0.01);
    measured("deviation",
             quantity(&e, "impulse_tangential_1")->moments.deviation / normal_impulse(), sqrt(all),
             2e-4);
    ensemble_lab_close(&e);
}

/* The stated coefficient with its deviation, as its median; 0 in a list is no friction. */
static void stated_deviation_and_none(void **state)
{
    (void)state;
    struct ensemble_lab e;
    open(&e, 1.0);
    e.request.contacts[0].friction = 0.075;
    e.inputs[0] = uncertain(INPUT_MODEL_FRICTION, 0, DISTRIBUTION_IS_NORMAL, 0.0, 1.0);
    ensemble_lab_run(&e, false);
    double variance = log1p(0.2 * 0.2), p = normal_impulse();
    const struct moments *t = &quantity(&e, "impulse_tangential_1")->moments;
    measured("mean", -t->mean / p, 0.075 * exp(0.5 * variance), 2e-5);
    measured("deviation", t->deviation / p, 0.2 * 0.075 * exp(0.5 * variance), 2e-4);
    assert_true(t->highest < 0.0);
    ensemble_lab_clear(&e);
    static const double list[] = {0.0, 0.05, 0.1};
    e.inputs[0] = uncertain(INPUT_FRICTION, 0, DISTRIBUTION_IS_LIST, NAN, NAN);
    e.inputs[0].values = list;
    e.inputs[0].value_count = 3;
    e.spec.samples = 0;
    e.spec.sampling = SAMPLING_IS_PLAIN;
    ensemble_lab_run(&e, false);
    for (int i = 0; i < 3; i++)
        measured("of a list", e.samples[i].tangential[0] / p, -list[i], 1e-6);
    ensemble_lab_close(&e);
}

static void refused(struct ensemble_lab *e, const char *words)
{
    struct fault fault = {""};
    assert_int_equal(ensemble_create(&e->ensemble, &e->spec, NULL, &fault), PERCUSS_BAD_REQUEST);
    if (!strstr(fault.text, words))
        fail_msg("%s: not: %s", fault.text, words);
}

static void refusals(void **state)
{
    (void)state;
    struct ensemble_lab e;
    open(&e, 1.0);
    e.inputs[0] = uncertain(INPUT_MODEL_FRICTION, 0, DISTRIBUTION_IS_NORMAL, 0.0, 1.0);
    refused(&e, "inputs[0].name: model-friction: contacts[0] must have friction");
    e.inputs[0] = uncertain(INPUT_FRICTION, 0, DISTRIBUTION_IS_UNIFORM, -0.1, 0.2);
    refused(&e, "inputs[0].first: -0.1: must be a coefficient >= 0 and <= 10");
    e.inputs[0].first = 0.1;
    e.request.options.friction = PERCUSS_FRICTION_NONE;
    refused(&e, "inputs[0].name: friction: must be another one with options.friction none");
    e.request.options.friction = PERCUSS_FRICTION_MICRO_SLIP;
    e.request.contacts[0].friction = 0.1;
    e.spec.input_count = 2;
    e.inputs[1] = uncertain(INPUT_MODEL_FRICTION, 0, DISTRIBUTION_IS_NORMAL, 0.0, 1.0);
    refused(&e, "inputs[1].name: model-friction: is inputs[0] already");
    lab_free(e.lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slides),
        cmocka_unit_test(sticks),
        cmocka_unit_test(indices_of_a_product),
        cmocka_unit_test(stated_deviation_and_none),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
