/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/law.h"

static double linear_force(const struct contact_law *law, double indentation, double *stiffness)
{
    *stiffness = indentation > 0.0 ? law->parameters[0] : 0.0;
    return *stiffness * indentation;
}

static double linear_stored(const struct contact_law *law, double indentation)
{
    return indentation > 0.0 ? 0.5 * law->parameters[0] * indentation * indentation : 0.0;
}

static double linear_indentation(const struct contact_law *law, double force)
{
    return force / law->parameters[0];
}

static void linear_rescale(struct contact_law *law, double force, double yield)
{
    (void)yield;
    law->parameters[0] *= force;
}

static const struct contact_law_operations linear_operations = {
    .model = PERCUSS_CONTACT_AUTO,
    .force = linear_force,
    .stored = linear_stored,
    .indentation = linear_indentation,
    .rescale = linear_rescale,
};

struct contact_law contact_law_linear(double stiffness)
{
    return (struct contact_law){.operations = &linear_operations, .parameters = {stiffness}};
}
