/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The elementary rod a second way: by d'Alembert's waves (waves.h) a sphere on a rod is one delay
 * equation, which a fine Runge-Kutta integration solves here without modes, truncation or residual
 * flexibility. */
#include "physics/support.h"
#include "physics/waves.h"

struct wave_rod {
    double mass;      /* of the sphere */
    double stiffness; /* Hertz */
    double impedance; /* Z */
    double period;    /* 2 L/c */
};

static double hertz(const struct wave_rod *rod, double indentation)
{
    return indentation > 0.0 ? rod->stiffness * indentation * sqrt(indentation) : 0.0;
}

/* Rates of (indentation, sphere's velocity) with a returned velocity. */
static void rates(const struct wave_rod *rod, double back, const double y[2], double rate[2])
{
    double force = hertz(rod, y[0]);
    rate[0] = y[1] - force / rod->impedance - back;
    rate[1] = -force / rod->mass;
}

/* Total impulse over `periods` returns of the wave, sphere at speed v on the rod at rest. The
 * middle of a step by Hermite's cubic; the kinks of the force fall on step ends. */
static double wave_impulse(const struct wave_rod *rod, double v, size_t per_period, size_t periods)
{
    struct wave_history past = {per_period, per_period * periods, NULL};
    double h = rod->period / (double)per_period;
    double y[2] = {0.0, v};
    past.force = calloc(2 * past.count + 1, sizeof *past.force);
    assert_non_null(past.force);
    for (size_t n = 0; n < past.count; n++) {
        double k[4][2];
        double back[3];
        double stage[2];
        for (size_t i = 0; i < 3; i++)
            back[i] = wave_returned(&past, rod->impedance, 2 * n + i);
        rates(rod, back[0], y, k[0]);
        for (int s = 1; s < 4; s++) {
            double part = s == 3 ? 1.0 : 0.5;
            for (int i = 0; i < 2; i++)
                stage[i] = y[i] + part * h * k[s - 1][i];
            rates(rod, back[s == 3 ? 2 : 1], stage, k[s]);
        }
        double old = y[0];
        for (int i = 0; i < 2; i++)
            y[i] += h / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
        double slope[2];
        rates(rod, back[2], y, slope);
        past.force[2 * n + 1] = hertz(rod, 0.5 * (old + y[0]) + 0.125 * h * (k[0][0] - slope[0]));
        past.force[2 * n + 2] = hertz(rod, y[0]);
    }
    free(past.force);
    return rod->mass * (v - y[1]);
}

static double wave_restitution(const struct body *ball, const struct body *bar, double v)
{
    struct wave_rod rod = {
        .mass = ball->mass,
        .stiffness = sphere_plane_stiffness(ball->material, bar->material, ball->radius),
        .impedance = sqrt(bar->material.young * bar->material.density) * bar->area,
        .period = 2.0 * bar->length * sqrt(bar->material.density / bar->material.young),
    };
    double compression = v / (1.0 / ball->mass + 1.0 / bar->mass);
    /* at least 400 steps in the contact alone, which lasts 2.94 d/v or more; 60 returns outlast the
     * contacts of every case below */
    double depth = pow(1.25 * ball->mass * v * v / rod.stiffness, 0.4);
    size_t steps = (size_t)fmax(2000.0, 400.0 * rod.period / (2.94 * depth / v));
    double fine = wave_impulse(&rod, v, 2 * steps, 60);
    double coarse = wave_impulse(&rod, v, steps, 60);
    /* the waves' own error, by halving the step: an order below what is asked of the modes */
    measured("waves, halved step", coarse / compression, fine / compression, 1e-7);
    return fine / compression - 1.0;
}

static void modes_and_waves_agree(void **state)
{
    (void)state;
    static struct solve_result result;
    static const struct {
        double length, ball, bar; /* radii */
    } sizes[] = {{1.0, 0.013, 0.010},  {0.6, 0.009, 0.012}, {0.3, 0.018, 0.008},
                 {0.12, 0.010, 0.015}, {0.5, 0.020, 0.006}, {0.25, 0.025, 0.007},
                 {0.4, 0.030, 0.005},  {0.1, 0.020, 0.010}, {0.8, 0.030, 0.006},
                 {0.2, 0.015, 0.004}};
    struct lab *lab = lab_create();
    uint64_t seed = 5;
    for (size_t i = 0; i < COUNT(sizes); i++) {
        struct material hard = {"hard",
                                random_between(&seed, 100e9, 300e9),
                                random_between(&seed, 0.1, 0.4),
                                random_between(&seed, 3e3, 9e3),
                                INFINITY,
                                0.0};
        struct material soft = {"soft",
                                random_between(&seed, 20e9, 200e9),
                                random_between(&seed, 0.1, 0.4),
                                random_between(&seed, 2e3, 9e3),
                                INFINITY,
                                0.0};
        double radius = sizes[i].ball;
        double length = sizes[i].length;
        double v = random_between(&seed, 0.05, 1.0);
        const struct body *ball = lab_add(lab, "ball", make_sphere(hard, radius));
        const struct body *rod =
            lab_add(lab, "rod", make_bar(&rod_kind, soft, sizes[i].bar, length));
        struct solve_request request =
            strike(sphere_spot("ball", radius), end_spot("rod", length), v);
        request.options.tolerance = 1e-7;
        lab_solve(lab, &request, &result);
        double round_trip = 2.0 * length * sqrt(soft.density / soft.young);
        double contact = result.contacts[0].sub_impacts[0].end;
        if (getenv("PERCUSS_MEASURE"))
            print_message("    contact %.2f round trips, %zu sub-impacts\n", contact / round_trip,
                          result.contacts[0].sub_impact_count);
        /* tolerance 1e-7 on the modes' side, up to 1e-7 on the waves' */
        measured("e", result.contacts[0].restitution, wave_restitution(ball, rod, v), 1e-6);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modes_and_waves_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
