/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "engine_model.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Half the angle that the motion has gone through when its force ends, cos(angle) = ratio; above
 * ratio 1 the angle is imaginary. */
static double half_angle(double ratio)
{
    return ratio < 1.0 ? acos(ratio) : acosh(ratio);
}

double spring_restitution(double ratio)
{
    double angle = half_angle(ratio);
    if (angle < 1e-4) /* angle / tan(angle) and angle / tanh(angle) are 1 -+ angle^2 / 3 */
        return exp(-2.0);
    return exp(-2.0 * angle / (ratio < 1.0 ? tan(angle) : tanh(angle)));
}

double spring_time(double ratio)
{
    double angle = half_angle(ratio);
    if (angle < 1e-4)
        return 2.0;
    return 2.0 * angle / (ratio < 1.0 ? sin(angle) : sinh(angle));
}

/* Halves until the two ends are neighbours, as numbers of the machine go. */
static double bisect(double (*value)(double at, double parameter), double parameter, double low,
                     double high)
{
    for (int i = 0; i < 200 && low < high; i++) {
        double middle = 0.5 * (low + high);
        if (value(middle, parameter) > 0.0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double above(double ratio, double restitution)
{
    return spring_restitution(ratio) - restitution;
}

double spring_ratio(double restitution)
{
    /* restitution < (2 ratio)^-2 for large ratios */
    return bisect(above, restitution, 0.0, 1.0 + 1.0 / sqrt(restitution));
}

/* The integral of x' dx' / (1 + d x') from the speed to -e times it, which is that of -k x dx / m
 * over the whole way, 0; times -d^2, so that it falls with e. */
static double left(double e, double damped)
{
    return (1.0 + e) * damped - log1p(damped) + log1p(-e * damped);
}

double hunt_crossley_restitution(double dissipation, double speed)
{
    double damped = dissipation * speed;
    if (damped < 1e-4) /* the logarithms cancel; the next term is of second order */
        return 1.0 - 2.0 / 3.0 * damped;
    return bisect(left, damped, 0.0, fmin(1.0, 1.0 / damped));
}

static double model_restitution(enum engine_law law, const struct engine_fit *fit, double speed)
{
    return law == ENGINE_CONSTANT ? fit->restitution
                                  : hunt_crossley_restitution(fit->dissipation, speed);
}

static double worst_of(enum engine_law law, const struct engine_fit *fit,
                       const struct engine_point *points, size_t count)
{
    double worst = 0.0;
    for (size_t i = 0; i < count; i++)
        worst =
            fmax(worst, fabs(model_restitution(law, fit, points[i].speed) - points[i].restitution));
    return worst;
}

/* The middle of all values is nearest to the farthest. */
static void fit_constant(struct engine_fit *fit, const struct engine_point *points, size_t count)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, points[i].restitution);
        high = fmax(high, points[i].restitution);
    }
    fit->restitution = 0.5 * (low + high);
}

/* The dissipation of a point by itself, between 0 and that of the point with the largest one: the
 * largest error falls, then rises, as each restitution falls with the dissipation. */
static double pointwise(double dissipation, const struct engine_point *point)
{
    return hunt_crossley_restitution(dissipation, point->speed) - point->restitution;
}

static double largest_dissipation(const struct engine_point *points, size_t count)
{
    double largest = 0.0;
    for (size_t i = 0; i < count; i++) {
        double high = 1.0 / points[i].speed;
        while (pointwise(high, &points[i]) > 0.0 && high < 1e6 / points[i].speed)
            high *= 2.0;
        largest = fmax(largest, high);
    }
    return largest;
}

static void fit_hunt_crossley(struct engine_fit *fit, const struct engine_point *points,
                              size_t count)
{
    /* thirds instead of the golden section: shorter, and as sure */
    double low = 0.0, high = largest_dissipation(points, count);
    for (int i = 0; i < 200; i++) {
        struct engine_fit lower = {.dissipation = low + (high - low) / 3.0},
                          upper = {.dissipation = high - (high - low) / 3.0};
        if (worst_of(ENGINE_HUNT_CROSSLEY, &lower, points, count) <
            worst_of(ENGINE_HUNT_CROSSLEY, &upper, points, count))
            high = upper.dissipation;
        else
            low = lower.dissipation;
    }
    fit->dissipation = 0.5 * (low + high);
}

struct engine_fit engine_fit(enum engine_law law, struct engine_point *points, size_t count,
                             double mass, double step)
{
    struct engine_fit fit = {.mass = mass};
    double logarithms = 0.0;
    for (size_t i = 0; i < count; i++)
        logarithms += log(points[i].duration) / (double)count;
    fit.duration = fmax(exp(logarithms), ENGINE_STEPS * step);
    fit.step = step > 0.0 ? step : fit.duration / ENGINE_STEPS;
    if (law == ENGINE_CONSTANT) {
        fit_constant(&fit, points, count);
        double ratio = spring_ratio(fmin(fit.restitution, 1.0));
        double frequency = spring_time(ratio) / fit.duration;
        fit.stiffness = mass * frequency * frequency;
        fit.damping = 2.0 * ratio * mass * frequency;
    } else {
        fit_hunt_crossley(&fit, points, count);
        /* as without the damper, which shifts the time of the contact but not the restitution */
        fit.stiffness = mass * (PI / fit.duration) * (PI / fit.duration);
    }
    for (size_t i = 0; i < count; i++)
        points[i].model = model_restitution(law, &fit, points[i].speed);
    fit.worst = worst_of(law, &fit, points, count);
    return fit;
}
