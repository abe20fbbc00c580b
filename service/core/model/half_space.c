/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lamb's solution: a normal force e^(i w t) of 1 N moves its point by
 *   -k/(2 pi mu) int_0^inf x a/f dx,  f = (2x^2 - 1)^2 - 4 x^2 a b,
 *   a = sqrt(x^2 - ratio^2),  b = sqrt(x^2 - 1),  k = w/c_T,  ratio = c_T/c_L,
 * x being wave numbers over k; a tangential one by
 *   k/(4 pi mu) int_0^inf x (1/b - b/f) dx,
 * 1/b by the shear waves that are polarised along the surface. The real part holds the static
 * compliance; the imaginary one, -w lag, comes from x < ratio (all waves run off), x < 1 (the shear
 * waves do) and the pole of f, Rayleigh's wave. */
#include "model/half_space.h"

#include <math.h>

/* Parts of both integrals of a lag. */
struct parts {
    double normal, along;
};

/* Both integrands with x^2 = from + (to - from) sin^2(t), which takes the roots out of them. */
static struct parts both_run_off(double ratio, double sine, double cosine)
{
    double x2 = ratio * ratio * sine * sine;
    double a = ratio * cosine;
    double b = sqrt(1.0 - x2);
    double g = 2.0 * x2 - 1.0;
    double f = g * g + 4.0 * x2 * a * b;
    return (struct parts){ratio * sine * a * a / f, ratio * sine * a * b / f};
}

static struct parts shear_runs_off(double ratio, double sine, double cosine)
{
    double width = 1.0 - ratio * ratio;
    double x2 = ratio * ratio + width * sine * sine;
    double g = 2.0 * x2 - 1.0;
    double ab2 = width * width * sine * sine * cosine * cosine;
    double f2 = g * g * g * g + 16.0 * x2 * x2 * ab2;
    return (struct parts){4.0 * x2 * ab2 * sqrt(width) * sine / f2,
                          g * g * width * sqrt(width) * sine * cosine * cosine / f2};
}

/* Of both, over t = 0 ... pi/2. With t = pi/2 (u - sin(2 pi u)/(2 pi)) the midpoint rule's error
 * falls with the sixth power of the points: 1e-9, along the surface 3e-7. */
static struct parts run_off(double ratio)
{
    enum { POINTS = 64 };
    struct parts sum = {0.0, 0.0};
    for (int i = 0; i < POINTS; i++) {
        double u = (i + 0.5) / POINTS;
        double t = 0.5 * M_PI * (u - sin(2.0 * M_PI * u) / (2.0 * M_PI));
        double weight = 0.5 * M_PI * (1.0 - cos(2.0 * M_PI * u)) / POINTS;
        double sine = sin(t);
        double cosine = cos(t);
        struct parts both = both_run_off(ratio, sine, cosine);
        struct parts shear = shear_runs_off(ratio, sine, cosine);
        sum.normal += weight * (both.normal + shear.normal);
        sum.along += weight * (both.along + shear.along);
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

/* pi times the residues of x a/f and x b/f there. */
static struct parts pole(double ratio, double x)
{
    double a = sqrt(x * x - ratio * ratio);
    double b = sqrt(x * x - 1.0);
    double slope =
        8.0 * x * (2.0 * x * x - 1.0) - 8.0 * x * a * b - 4.0 * x * x * x * (b / a + a / b);
    return (struct parts){M_PI * x * a / fabs(slope), M_PI * x * b / fabs(slope)};
}

struct half_space_waves half_space_waves_of(const struct material *material)
{
    double nu = material->poisson;
    double mu = material_shear_modulus(material);
    double ratio = sqrt((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)));
    double transverse = sqrt(mu / material->density);
    double slow = slowness(ratio);
    struct parts off = run_off(ratio), wave = pole(ratio, slow);
    /* int x/b from 0 to 1 is 1 */
    double along = 1.0 + off.along + wave.along;
    return (struct half_space_waves){
        .lag = (off.normal + wave.normal) / (2.0 * M_PI * mu * transverse),
        .lag_along = along / (4.0 * M_PI * mu * transverse),
        .rayleigh = transverse / slow,
        .transverse = transverse,
    };
}
