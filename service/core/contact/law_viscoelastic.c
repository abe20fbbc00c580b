/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "contact/hertz.h"
#include "contact/law.h"
#include "model/relaxation.h"

/* The force of a sudden indentation: scales and starting values. */
static double instantaneous_force(const struct contact_law *law, double indentation,
                                  double *stiffness)
{
    double root = indentation > 0.0 ? sqrt(indentation) : 0.0;
    *stiffness = 1.5 * law->parameters[0] * root;
    return root > 0.0 ? law->parameters[0] * indentation * root : 0.0;
}

/* What a contact that is held gives back in the end. */
static double stored_at_last(const struct contact_law *law, double indentation)
{
    const struct relaxation *relaxation = law->table;
    double stays = relaxation_storage(relaxation, 0.0);
    if (!(indentation > 0.0))
        return 0.0;
    return 0.4 * stays * law->parameters[0] * indentation * indentation * sqrt(indentation);
}

static double instantaneous_indentation(const struct contact_law *law, double force)
{
    double root = cbrt(force / law->parameters[0]);
    return root * root;
}

static void rescale(struct contact_law *law, double force, double yield)
{
    (void)yield;
    law->parameters[0] *= force;
}

static struct contact_law without_relaxation(const struct hertz_contact *hertz,
                                             const struct material *a, const struct material *b)
{
    (void)a, (void)b;
    return contact_law_hertz(hertz->stiffness);
}

const struct contact_law_operations contact_law_VISCOELASTIC = {
    .model = PERCUSS_CONTACT_VISCOELASTIC,
    .effort = CONTACT_EFFORT_SHORT,
    .make = without_relaxation,
    .title = "viscoelastic Hertz contact",
    .elliptic = true,
    .lossy = true,
    .remembers = true,
    .force = instantaneous_force,
    .stored = stored_at_last,
    .indentation = instantaneous_indentation,
    .rescale = rescale,
};

struct contact_law contact_law_viscoelastic(double stiffness, const struct relaxation *relaxation)
{
    return (struct contact_law){
        .operations = &contact_law_VISCOELASTIC, .parameters = {stiffness}, .table = relaxation};
}
