/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/engine_model.c: the closed forms beside their equations of motion, step by step,
 * and the fits. */
#include <math.h>

#include "check.h"
#include "engine_model.h"

/* What a simulator computes of unit mass, stiffness and speed: the force on the body. */
typedef double force_function(double x, double rate, double parameter);

static double spring(double x, double rate, double ratio)
{
    return fmax(x + 2.0 * ratio * rate, 0.0);
}

static double hunt_crossley(double x, double rate, double damped)
{
    return fmax(x * (1.0 + damped * rate), 0.0);
}

struct outcome {
    double restitution, time;
};

/* From the touch until the force ends, by Runge and Kutta's steps. */
static struct outcome impact_of(force_function *force, double parameter)
{
    const double h = 1e-5;
    double x = 0.0, v = 1.0, t = 0.0;
    do {
        double a1 = -force(x, v, parameter);
        double v2 = v + 0.5 * h * a1, a2 = -force(x + 0.5 * h * v, v2, parameter);
        double v3 = v + 0.5 * h * a2, a3 = -force(x + 0.5 * h * v2, v3, parameter);
        double v4 = v + h * a3, a4 = -force(x + h * v3, v4, parameter);
        x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        t += h;
    } while (force(x, v, parameter) > 0.0);
    return (struct outcome){-v, t};
}

/* 1e-9: the steps, of fourth order; 1e-4 of the time: the step in which the force ends. */
static void closed_forms(void **state)
{
    static const double ratios[] = {0.0,  1e-3,      0.05, 0.3, 0.70710678,
                                    0.95, 0.9999999, 1.0,  1.2, 4.0};
    static const double damped[] = {1e-5, 0.01, 0.3, 1.0, 3.0, 20.0};
    (void)state;
    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++) {
        struct outcome outcome = impact_of(spring, ratios[i]);
        near(spring_restitution(ratios[i]), outcome.restitution, 1e-9);
        near(spring_time(ratios[i]), outcome.time, 1e-4);
        near(spring_restitution(spring_ratio(outcome.restitution)), outcome.restitution, 1e-12);
    }
    for (size_t i = 0; i < sizeof damped / sizeof damped[0]; i++)
        near(hunt_crossley_restitution(damped[i] / 0.4, 0.4),
             impact_of(hunt_crossley, damped[i]).restitution, 1e-9);
}

/* A restitution that falls with the speed. */
static struct engine_point points[5];

static void set_points(void)
{
    for (int i = 0; i < 5; i++)
        points[i] = (struct engine_point){.speed = 0.1 * (i + 1),
                                          .restitution = 0.9 - 0.12 * i,
                                          .duration = 1e-4 * pow(0.1 * (i + 1), -0.2)};
}

static void nearest_constant(void **state)
{
    (void)state;
    set_points();
    struct engine_fit fit = engine_fit(ENGINE_CONSTANT, points, 5, 0.02, 0.0);
    near(fit.restitution, 0.66, 1e-12);
    near(fit.worst, 0.24, 1e-12);
    near(points[3].model, 0.66, 1e-12);
    /* stiffness and damping have that restitution and that time */
    double frequency = sqrt(fit.stiffness / 0.02);
    double ratio = 0.5 * fit.damping / (0.02 * frequency);
    struct outcome outcome = impact_of(spring, ratio);
    near(outcome.restitution, 0.66, 1e-9);
    near(outcome.time / frequency, fit.duration, 1e-4 * fit.duration);
    near(fit.duration, 1e-4 * pow(0.1 * pow(120.0, 0.2), -0.2), 1e-12);
    near(fit.step, fit.duration / ENGINE_STEPS, 1e-18);
}

/* No other dissipation is nearer at the worst of the points. */
static void nearest_hunt_crossley(void **state)
{
    (void)state;
    set_points();
    struct engine_fit fit = engine_fit(ENGINE_HUNT_CROSSLEY, points, 5, 0.02, 0.0);
    for (double factor = 0.9; factor < 1.11; factor += 0.2) {
        double worst = 0.0;
        for (int i = 0; i < 5; i++)
            worst = fmax(worst,
                         fabs(hunt_crossley_restitution(factor * fit.dissipation, points[i].speed) -
                              points[i].restitution));
        assert_true(worst > fit.worst);
    }
    /* its own law is found again */
    for (int i = 0; i < 5; i++)
        points[i].restitution = hunt_crossley_restitution(1.7, points[i].speed);
    fit = engine_fit(ENGINE_HUNT_CROSSLEY, points, 5, 0.02, 0.0);
    near(fit.dissipation, 1.7, 1e-9);
    near(fit.worst, 0.0, 1e-9);
}

/* A simulator's own step makes the contact longer, and leaves the restitution. */
static void softer_for_long_steps(void **state)
{
    (void)state;
    set_points();
    struct engine_fit stiff = engine_fit(ENGINE_CONSTANT, points, 5, 0.02, 1e-7);
    struct engine_fit soft = engine_fit(ENGINE_CONSTANT, points, 5, 0.02, 1e-3);
    near(stiff.step, 1e-7, 0.0);
    near(soft.duration, 0.05, 1e-15);
    near(soft.restitution, stiff.restitution, 0.0);
    near(soft.stiffness * soft.duration * soft.duration,
         stiff.stiffness * stiff.duration * stiff.duration, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms),
        cmocka_unit_test(nearest_constant),
        cmocka_unit_test(nearest_hunt_crossley),
        cmocka_unit_test(softer_for_long_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
