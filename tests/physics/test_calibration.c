/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Calibration (client/measured/calibration.c) with the solver on synthetic measurements of another
 * model: Young's modulus is recovered within its interval, and what such data do not determine has
 * no narrow interval. */
#include "physics/synthetic.h"

#include "calibration.h"
#include "distance.h"

struct model {
    struct lab *lab;
    const struct measured_set *set;
    size_t parameters;
    enum percuss_parameter parameter[2];
    double start[2], size[2];
};

static struct lab *make_lab(void)
{
    struct lab *lab = lab_create();
    struct body other = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    lab_add(lab, "sphere", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", other);
    lab_add(lab, "true-beam", synthetic_beam());
    other.theory = THEORY_EULER_BERNOULLI;
    lab_add(lab, "slender-beam", other);
    return lab;
}

static bool simulate(void *context, const double *x, double faster, struct measured_impact *twins)
{
    static struct solve_result result;
    const struct model *model = context;
    for (size_t i = 0; i < model->set->count; i++) {
        double speed = faster * model->set->impacts[i].speed;
        struct solve_request request = synthetic_strike("sphere", "beam", speed);
        for (size_t k = 0; k < model->parameters; k++)
            request.bodies[1].variations[request.bodies[1].variation_count++] =
                (struct body_variation){model->parameter[k],
                                        fabs(model->start[k] + (x[k] - 1.0) * model->size[k])};
        enum percuss_status status =
            solve(model->lab->workspace, &model->lab->means, &request, &result);
        if (status != PERCUSS_OK && status != PERCUSS_TRUNCATED)
            fail_msg("%s", result.fault.text);
        twins[i] = synthetic_impact(&result, speed);
    }
    return true;
}

static void calibrate(const struct model *model, struct calibration *calibration)
{
    struct calibration_problem problem = {model->set, model->parameters, simulate, (void *)model,
                                          0.01};
    *calibration = (struct calibration){.fit.x = {1.0, 1.0}};
    assert_true(calibration_solve(&problem, calibration));
}

/* 50 impacts with 1 % noise, ten times. An interval of 95 % holds nine times at least with
 * probability 0.91; PERCUSS_TRIALS=100 counts more of them. */
static void young_is_recovered_within_its_interval(void **state)
{
    (void)state;
    struct lab *lab = make_lab();
    const char *asked = getenv("PERCUSS_TRIALS");
    int trials = asked ? atoi(asked) : 10, within = 0;
    for (int trial = 0; trial < trials; trial++) {
        struct measured_set set;
        struct calibration calibration;
        synthetic_measure(lab, "true-beam", 50, 0.01, 1000 + (uint64_t)trial, &set);
        struct model model = {lab, &set, 1, {PERCUSS_PARAMETER_YOUNG}, {70e9}, {70e9}};
        calibrate(&model, &calibration);
        double young = 70e9 * calibration.fit.x[0], half = 70e9 * calibration.fit.half_width[0];
        bool inside = fabs(young - SYNTHETIC_YOUNG) <= half;
        within += inside;
        if (getenv("PERCUSS_MEASURE"))
            print_message("    %.3f +- %.3f GPa, noise %.2f %.2f %.2f %%, used %zu %zu %zu, %u "
                          "evaluations%s\n",
                          young / 1e9, half / 1e9, 100 * calibration.noise[0],
                          100 * calibration.noise[1], 100 * calibration.noise[2],
                          calibration.used[0], calibration.used[1], calibration.used[2],
                          calibration.fit.evaluations, inside ? "" : " MISSED");
        /* an interval that says something */
        assert_true(half < 0.02 * young);
        measured_set_free(&set);
    }
    if (asked)
        print_message("    within the interval: %d of %d\n", within, trials);
    assert_true(within >= 9 * trials / 10);
    lab_free(lab);
}

/* Within a few milliseconds a damping ratio of 3e-4 takes next to nothing. */
static void damping_is_not_determined(void **state)
{
    (void)state;
    struct lab *lab = make_lab();
    struct measured_set set;
    struct calibration calibration;
    synthetic_measure(lab, "true-beam", 50, 0.01, 7, &set);
    struct model model = {lab,         &set,
                          2,           {PERCUSS_PARAMETER_YOUNG, PERCUSS_PARAMETER_DAMPING},
                          {70e9, 0.0}, {70e9, 0.01}};
    calibrate(&model, &calibration);
    double young = 70e9 * calibration.fit.x[0], half = 70e9 * calibration.fit.half_width[0];
    measured("Young's modulus beside damping", young, SYNTHETIC_YOUNG, 2.0 * half);
    double damping = fabs(calibration.fit.x[1] - 1.0) * 0.01;
    assert_true(0.01 * calibration.fit.half_width[1] > 0.5 * damping);
    measured_set_free(&set);
    lab_free(lab);
}

static size_t restitutions(struct lab *lab, const char *beam, const struct measured_set *set,
                           double *e)
{
    static struct solve_result result;
    for (size_t i = 0; i < set->count; i++) {
        struct solve_request request = synthetic_strike("sphere", beam, set->impacts[i].speed);
        solve(lab->workspace, &lab->means, &request, &result);
        e[i] = result.contacts[0].restitution;
    }
    return set->count;
}

/* The distributions of e tell a Timoshenko beam's measurements from a slender beam's, and not from
 * a Timoshenko beam's. */
static void distributions_tell_theories_apart(void **state)
{
    (void)state;
    enum { IMPACTS = 150 };
    static double measured_e[IMPACTS], e[IMPACTS];
    struct lab *lab = make_lab();
    struct measured_set set;
    struct distance kolmogorov, energy;
    synthetic_measure(lab, "true-beam", IMPACTS, 0.01, 5, &set);
    for (size_t i = 0; i < set.count; i++)
        measured_e[i] = set.impacts[i].restitution;
    restitutions(lab, "beam", &set, e);
    assert_true(distance_kolmogorov(measured_e, IMPACTS, e, IMPACTS, &kolmogorov));
    assert_true(distance_energy(measured_e, IMPACTS, e, IMPACTS, 999, 1, &energy));
    if (getenv("PERCUSS_MEASURE"))
        print_message("    same theory: p %.3g %.3g\n", kolmogorov.p, energy.p);
    assert_true(kolmogorov.p > 0.05 && energy.p > 0.05);
    restitutions(lab, "slender-beam", &set, e);
    assert_true(distance_kolmogorov(measured_e, IMPACTS, e, IMPACTS, &kolmogorov));
    assert_true(distance_energy(measured_e, IMPACTS, e, IMPACTS, 999, 1, &energy));
    if (getenv("PERCUSS_MEASURE"))
        print_message("    slender beam: p %.3g %.3g\n", kolmogorov.p, energy.p);
    assert_true(kolmogorov.p < 0.01 && energy.p < 0.01);
    measured_set_free(&set);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(young_is_recovered_within_its_interval),
        cmocka_unit_test(damping_is_not_determined),
        cmocka_unit_test(distributions_tell_theories_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
