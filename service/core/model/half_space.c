/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lamb's solution: a force e^(i w t) of 1 N moves its point by
 *   -k/(2 pi mu) int_0^inf x a/f dx,  f = (2x^2 - 1)^2 - 4 x^2 a b,
 *   a = sqrt(x^2 - ratio^2),  b = sqrt(x^2 - 1),  k = w/c_T,  ratio = c_T/c_L,
 * x being wave numbers over k. The real part holds the static compliance; the imaginary one, -w
 * lag, comes from x < ratio (both waves run off), x < 1 (the shear wave does) and the pole of f,
 * Rayleigh's wave. */
#include "model/half_space.h"

#include <math.h>

/* Both integrands with x^2 = from + (to - from) sin^2(t), which takes the roots out of them. */
static double both_run_off(double ratio, double sine, double cosine)
{
    double x2 = ratio * ratio * sine * sine;
    double a = ratio * cosine;
    double b = sqrt(1.0 - x2);
    double g = 2.0 * x2 - 1.0;
    return ratio * sine * a * a / (g * g + 4.0 * x2 * a * b);
}

static double shear_runs_off(double ratio, double sine, double cosine)
{
    double width = 1.0 - ratio * ratio;
    double x2 = ratio * ratio + width * sine * sine;
    double g = 2.0 * x2 - 1.0;
    double ab2 = width * width * sine * sine * cosine * cosine;
    return 4.0 * x2 * ab2 * sqrt(width) * sine / (g * g * g * g + 16.0 * x2 * x2 * ab2);
}

/* Of both, over t = 0 ... pi/2. With t = pi/2 (u - sin(2 pi u)/(2 pi)) the midpoint rule's error
 * falls with the sixth power of the points: 1e-9. */
static double run_off(double ratio)
{
    enum { POINTS = 64 };
    double sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double u = (i + 0.5) / POINTS;
        double t = 0.5 * M_PI * (u - sin(2.0 * M_PI * u) / (2.0 * M_PI));
        double weight = 0.5 * M_PI * (1.0 - cos(2.0 * M_PI * u)) / POINTS;
        double sine = sin(t);
        double cosine = cos(t);
        sum += weight * (both_run_off(ratio, sine, cosine) + shear_runs_off(ratio, sine, cosine));
    }
    return sum;
}

/* f for x > 1. */
static double rayleigh(double ratio, double x)
{
    double g = 2.0 * x * x - 1.0;
    return g * g - 4.0 * x * x * sqrt((x * x - ratio * ratio) * (x * x - 1.0));
}

/* c_T over the speed of Rayleigh's wave: the root of f, between 1.04 and 1.46. */
static double slowness(double ratio)
{
    double low = 1.0;
    double high = 1.5;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        if (rayleigh(ratio, middle) > 0.0)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* pi times the residue of x a/f there. */
static double pole(double ratio, double x)
{
    double a = sqrt(x * x - ratio * ratio);
    double b = sqrt(x * x - 1.0);
    double slope =
        8.0 * x * (2.0 * x * x - 1.0) - 8.0 * x * a * b - 4.0 * x * x * x * (b / a + a / b);
    return M_PI * x * a / fabs(slope);
}

struct half_space_waves half_space_waves_of(const struct material *material)
{
    double nu = material->poisson;
    double mu = material_shear_modulus(material);
    double ratio = sqrt((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)));
    double transverse = sqrt(mu / material->density);
    double slow = slowness(ratio);
    double sum = run_off(ratio) + pole(ratio, slow);
    return (struct half_space_waves){
        .lag = sum / (2.0 * M_PI * mu * transverse),
        .rayleigh = transverse / slow,
        .transverse = transverse,
    };
}
