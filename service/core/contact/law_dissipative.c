/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Hunt and Crossley's law (J. Appl. Mech. 42 (1975) 440), see contact_law_dissipative. */
#include <math.h>

#include "contact/law.h"

enum { STIFFNESS, EXPONENT, DISSIPATION };

/* At rest: k d^n. */
static double elastic_force(const struct contact_law *law, double indentation, double *stiffness)
{
    double k = law->parameters[STIFFNESS], n = law->parameters[EXPONENT];
    *stiffness = 0.0;
    if (!(indentation > 0.0))
        return 0.0;
    double force = k * pow(indentation, n);
    *stiffness = n * force / indentation;
    return force;
}

static double moving_force(const struct contact_law *law, double indentation, double rate,
                           double *stiffness, double *viscosity)
{
    double c = law->parameters[DISSIPATION], factor = 1.0 + c * rate;
    double elastic = elastic_force(law, indentation, stiffness);
    if (!(factor > 0.0))
        elastic = factor = 0.0;
    *stiffness *= factor;
    *viscosity = c * elastic;
    return elastic * factor;
}

static double elastic_energy(const struct contact_law *law, double indentation)
{
    double stiffness, force = elastic_force(law, indentation, &stiffness);
    return indentation > 0.0 ? force * indentation / (law->parameters[EXPONENT] + 1.0) : 0.0;
}

static double elastic_indentation(const struct contact_law *law, double force)
{
    return pow(force / law->parameters[STIFFNESS], 1.0 / law->parameters[EXPONENT]);
}

static void rescale(struct contact_law *law, double force, double yield)
{
    (void)yield;
    law->parameters[STIFFNESS] *= force;
}

static const struct contact_law_operations dissipative_operations = {
    .model = PERCUSS_CONTACT_LAW,
    .effort = CONTACT_EFFORT_SHORT,
    .title = "Hunt and Crossley's law",
    .lossy = true,
    .force = elastic_force,
    .moving = moving_force,
    .stored = elastic_energy,
    .indentation = elastic_indentation,
    .rescale = rescale,
};

struct contact_law contact_law_dissipative(double stiffness, double exponent, double dissipation)
{
    return (struct contact_law){.operations = &dissipative_operations,
                                .parameters = {stiffness, exponent, dissipation}};
}
