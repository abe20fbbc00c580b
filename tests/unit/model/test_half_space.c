/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/half_space.c: Rayleigh's speed, the radiated power by a contour in the
 * complex plane, and what of it runs off as which wave. */
#include <complex.h>

#include "check.h"
#include "model/half_space.h"

static const double pi = 3.14159265358979323846;

/* mu = 1 Pa, c_T = 1 m/s. */
static struct material unit_material(double poisson)
{
    return (struct material){"unit", 2.0 * (1.0 + poisson), poisson, 1.0, INFINITY, 0.0};
}

static double speed_ratio(double poisson)
{
    return sqrt((1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson)));
}

static const double POISSON[] = {-0.5, -0.01, 0.0, 0.1, 0.25, 0.3, 0.33, 0.45, 0.499};
enum { MATERIALS = sizeof POISSON / sizeof *POISSON };

/* The two closed forms: (3 - sqrt 5)^(1/2) and (2 - 2/sqrt 3)^(1/2). */
static void rayleigh_waves_are_as_fast_as_he_says(void **state)
{
    (void)state;
    const struct material cork = unit_material(0.0);
    const struct material rock = unit_material(0.25);
    near(half_space_waves_of(&cork).rayleigh, sqrt(3.0 - sqrt(5.0)), 1e-14);
    near(half_space_waves_of(&rock).rayleigh, sqrt(2.0 - 2.0 / sqrt(3.0)), 1e-14);
    near(half_space_waves_of(&rock).transverse, 1.0, 1e-14);
}

static double complex rayleigh_function(double complex x, double ratio)
{
    double complex g = 2.0 * x * x - 1.0;
    return g * g - 4.0 * x * x * csqrt(x * x - ratio * ratio) * csqrt(x * x - 1.0);
}

/* Lamb's integrals from 0 to 3 on an arc above the axis, past every singularity: what lies beyond is
 * real. Midpoints whose ends are passed with vanishing speed. */
static double lag_by_contour(double ratio, bool along)
{
    enum { POINTS = 4000 };
    double complex sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double u = (i + 0.5) / POINTS;
        double s = pi * (u - sin(2.0 * pi * u) / (2.0 * pi));
        double speed = pi * (1.0 - cos(2.0 * pi * u)) / POINTS;
        double complex x = 1.5 * (1.0 - cos(s)) + 0.7 * I * sin(s);
        double complex dx = speed * (1.5 * sin(s) + 0.7 * I * cos(s));
        double complex a = csqrt(x * x - ratio * ratio), b = csqrt(x * x - 1.0);
        double complex f = rayleigh_function(x, ratio);
        sum += x * (along ? 0.5 * (1.0 / b - b / f) : a / f) * dx;
    }
    return fabs(cimag(sum)) / (2.0 * pi);
}

static void the_power_is_lamb_s(void **state)
{
    (void)state;
    for (size_t i = 0; i < MATERIALS; i++) {
        struct material material = unit_material(POISSON[i]);
        /* the rule's error with its 64 points: 2.4e-7 along the surface, of Poisson's ratio -0.5 */
        double lag = half_space_waves_of(&material).lag;
        double along = half_space_waves_of(&material).lag_along;
        near(lag, lag_by_contour(speed_ratio(POISSON[i]), false), 1e-9);
        near(along, lag_by_contour(speed_ratio(POISSON[i]), true), 1e-6);
        /* dimensions: 1/(mu c_T) */
        material.young *= 70e9;
        material.density *= 2700.0;
        double scale = 70e9 * sqrt(70e9 / 2700.0);
        near(half_space_waves_of(&material).lag * scale, lag, 1e-12);
        near(half_space_waves_of(&material).lag_along * scale, along, 1e-12);
    }
}

/* Mean power over the square of the force's rate, times 2, that runs off far away as longitudinal
 * [0] and shear waves [1]: the far fields of Miller and Pursey (Proc. R. Soc. A 223 (1954) 521). */
static void powers_far_away(double ratio, double power[2])
{
    enum { POINTS = 200000 };
    power[0] = power[1] = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double angle = 0.5 * pi * (i + 0.5) / POINTS;
        double s = sin(angle);
        double ring = 2.0 * pi * s * 0.5 * pi / POINTS;
        double complex along = cos(angle) * ratio * ratio * (1.0 - 2.0 * ratio * ratio * s * s) /
                               rayleigh_function(ratio * s, ratio) / (2.0 * pi);
        double complex across = sin(2.0 * angle) * csqrt(ratio * ratio - s * s) /
                                rayleigh_function(s, ratio) / (2.0 * pi);
        power[0] += ring / ratio * creal(along * conj(along));
        power[1] += ring * creal(across * conj(across));
    }
}

/* A quarter: 7, 26 and 67 % for longitudinal, shear and Rayleigh waves (Miller and Pursey, Proc. R.
 * Soc. A 233 (1955) 55). */
static void it_runs_off_as_three_waves(void **state)
{
    (void)state;
    double power[2];
    const struct material rock = unit_material(0.25);
    double lag = half_space_waves_of(&rock).lag;
    powers_far_away(speed_ratio(0.25), power);
    near(power[0] / lag, 0.07, 0.005);
    near(power[1] / lag, 0.26, 0.005);
    near(1.0 - (power[0] + power[1]) / lag, 0.67, 0.005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rayleigh_waves_are_as_fast_as_he_says),
        cmocka_unit_test(the_power_is_lamb_s),
        cmocka_unit_test(it_runs_off_as_three_waves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
