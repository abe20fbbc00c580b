/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Powers of the indentation, F = k d^n: elastic, with hysteresis, or with Hunt and Crossley's
 * dissipation (J. Appl. Mech. 42 (1975) 440).
 *
 * With hysteresis the force is that while it grows. From the largest indentation D back, F = k D^n
 * (d/D)^m: with m + 1 = (n + 1)/(1 - hysteresis) the work k D^(n+1)/(m + 1) that comes back is 1 -
 * hysteresis of that of loading, whatever D is, so that e^2 = 1 - hysteresis of rigid bodies. It
 * leaves no dent. */
#include <math.h>

#include "contact/law.h"
#include "contact/plastic.h"

/* The third is m of one, the dissipation of the other. */
enum { STIFFNESS, EXPONENT, BACK, DISSIPATION = BACK };

static double power_force(const struct contact_law *law, double d, double *slope)
{
    double n = law->parameters[EXPONENT];
    *slope = 0.0;
    if (!(d > 0.0))
        return 0.0;
    double force = law->parameters[STIFFNESS] * pow(d, n);
    *slope = n * force / d;
    return force;
}

static double power_work(const struct contact_law *law, double d)
{
    double slope;
    return power_force(law, d, &slope) * fmax(d, 0.0) / (law->parameters[EXPONENT] + 1.0);
}

static double power_indentation(const struct contact_law *law, double force)
{
    return pow(force / law->parameters[STIFFNESS], 1.0 / law->parameters[EXPONENT]);
}

static void power_rescale(struct contact_law *law, double force, double yield)
{
    (void)yield;
    law->parameters[STIFFNESS] *= force;
}

/* F (1 + dissipation d'), never pulling. */
static double moving_force(const struct contact_law *law, double indentation, double rate,
                           double *stiffness, double *viscosity)
{
    double c = law->parameters[DISSIPATION], factor = 1.0 + c * rate;
    double elastic = power_force(law, indentation, stiffness);
    if (!(factor > 0.0))
        elastic = factor = 0.0;
    *stiffness *= factor;
    *viscosity = c * elastic;
    return elastic * factor;
}

static double no_joint(const struct contact_law *law, double d)
{
    (void)law, (void)d;
    return INFINITY;
}

/* It loses from the first touch on, and leaves neither dent nor radius. */
static double nothing(const struct contact_law *law)
{
    (void)law;
    return 0.0;
}

static double nothing_at(const struct contact_law *law, double d)
{
    (void)law, (void)d;
    return 0.0;
}

static double power_branch(const struct contact_law *law, double x, double *slope)
{
    double m = law->parameters[BACK], share = pow(x, m);
    *slope = m * share / x;
    return share;
}

static double power_branch_work(const struct contact_law *law, double x)
{
    double m = law->parameters[BACK];
    return pow(x, m + 1.0) / (m + 1.0);
}

static const struct plastic_curve power_curve = {
    .force = power_force,
    .work = power_work,
    .joint = no_joint,
    .yield = nothing,
    .residual = nothing_at,
    .radius = nothing_at,
    .branch = power_branch,
    .branch_work = power_branch_work,
};

static const struct contact_law_operations elastic_power = {
    .model = PERCUSS_CONTACT_LAW,
    .title = "a power of the indentation",
    .force = power_force,
    .stored = power_work,
    .indentation = power_indentation,
    .rescale = power_rescale,
};

static const struct contact_law_operations lossy_power = {
    .model = PERCUSS_CONTACT_LAW,
    .title = "a power of the indentation with hysteresis",
    .force = plastic_force,
    .stored = plastic_stored,
    .indentation = power_indentation,
    .curve = &power_curve,
    .rescale = power_rescale,
};

static const struct contact_law_operations dissipative_power = {
    .model = PERCUSS_CONTACT_LAW,
    .title = "Hunt and Crossley's law",
    .lossy = true,
    .force = power_force,
    .moving = moving_force,
    .stored = power_work,
    .indentation = power_indentation,
    .rescale = power_rescale,
};

struct contact_law contact_law_power(double stiffness, double exponent, double hysteresis)
{
    return (struct contact_law){
        .operations = hysteresis > 0.0 ? &lossy_power : &elastic_power,
        .parameters = {stiffness, exponent, (exponent + 1.0) / (1.0 - hysteresis) - 1.0}};
}

struct contact_law contact_law_dissipative(double stiffness, double exponent, double dissipation)
{
    return (struct contact_law){.operations = &dissipative_power,
                                .parameters = {stiffness, exponent, dissipation}};
}
