/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "contact/hertz.h"
#include "contact/law.h"

static double hertz_force(const struct contact_law *law, double indentation, double *stiffness)
{
    if (!(indentation > 0.0)) {
        *stiffness = 0.0;
        return 0.0;
    }
    double root = sqrt(indentation);
    *stiffness = 1.5 * law->parameters[0] * root;
    return law->parameters[0] * indentation * root;
}

/* Two indentations at any address, and the result of their comparison. */
typedef double pair __attribute__((vector_size(2 * sizeof(double)), aligned(8)));
typedef long long mask __attribute__((vector_size(2 * sizeof(long long))));

static void hertz_forces(const struct contact_law *law,
                         const double indentation[CONTACT_LAW_AT_ONCE],
                         double force[CONTACT_LAW_AT_ONCE], double stiffness[CONTACT_LAW_AT_ONCE])
{
    double k = law->parameters[0];
    for (int i = 0; i < CONTACT_LAW_AT_ONCE; i += 2) {
        pair d = *(const pair *)(indentation + i);
        d = (pair)((mask)d & (d > 0.0)); /* no force where it is open */
        const pair root = {sqrt(d[0]), sqrt(d[1])};
        *(pair *)(stiffness + i) = 1.5 * k * root;
        *(pair *)(force + i) = k * d * root;
    }
}

static double hertz_stored(const struct contact_law *law, double indentation)
{
    if (!(indentation > 0.0))
        return 0.0;
    return 0.4 * law->parameters[0] * indentation * indentation * sqrt(indentation);
}

static double hertz_indentation(const struct contact_law *law, double force)
{
    double root = cbrt(force / law->parameters[0]);
    return root * root;
}

static void hertz_rescale(struct contact_law *law, double force, double yield)
{
    (void)yield;
    law->parameters[0] *= force;
}

static struct contact_law hertz_make(const struct hertz_contact *hertz, const struct material *a,
                                     const struct material *b)
{
    (void)a, (void)b;
    return contact_law_hertz(hertz->stiffness);
}

const struct contact_law_operations contact_law_HERTZ = {
    .model = PERCUSS_CONTACT_HERTZ,
    .effort = CONTACT_EFFORT_LEAST,
    .make = hertz_make,
    .title = "elastic Hertz contact",
    .three_halves = true,
    .elliptic = true,
    .force = hertz_force,
    .forces = hertz_forces,
    .stored = hertz_stored,
    .indentation = hertz_indentation,
    .rescale = hertz_rescale,
};

struct contact_law contact_law_hertz(double stiffness)
{
    return (struct contact_law){.operations = &contact_law_HERTZ, .parameters = {stiffness}};
}
