/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/strain_rate.h"

#include <math.h>
#include <stdbool.h>

#include "contact/law_closed_form.h"
#include "contact/plastic.h"

/* See strain_rate.h. */
static const double SHARE = 0.35;
static const double POWER = 0.8;
/* A rate that changes by less has been found. Factors larger by f make the rate larger by f^1.25 at
 * most, and a rate the factor by its sensitivity, a fifth or less for most metals: a round leaves
 * some quarter of the error. The search comes down from the rate of an elastic contact. */
static const double FOUND = 1e-9;
enum { ROUNDS = 200 };

/* A contact at the largest indentation of a blow. */
struct deepest {
    double springs; /* share of the indentation that its unloading stiffness would give back */
    double radius;  /* m */
};

static struct deepest find_deepest(const struct hertz_contact *hertz,
                                   const struct material materials[2], double work)
{
    struct contact_law law = contact_law_closed_form(hertz, &materials[0], &materials[1]);
    double depth = contact_law_depth(&law, work);
    struct deepest deepest = {2.0 / 3.0, law.operations->curve->radius(&law, depth)}; /* Hertz */
    if (depth > law.operations->curve->yield(&law)) {
        struct contact_law after = contact_law_after(&law, depth);
        deepest.springs = after.history.max_force / (contact_law_unloading(&after) * depth);
    }
    return deepest;
}

void strain_rate_of(const struct hertz_contact *hertz, const struct material *const materials[2],
                    const struct yield_rate *const stated[2], const struct strain_rate_blow *blow,
                    struct strain_rate found[2])
{
    struct material raised[2] = {*materials[0], *materials[1]};
    for (int which = 0; which < 2; which++) {
        bool depends = yield_rate_is_stated(stated[which]) && isfinite(materials[which]->yield);
        found[which] = (struct strain_rate){.rate = depends ? INFINITY : 0.0, .factor = 1.0};
        if (depends)
            raised[which].yield = materials[which]->young; /* the bound at any rate */
    }
    bool settled = false;
    for (int i = 0; i < ROUNDS && !settled; i++) {
        struct deepest deepest = find_deepest(hertz, raised, blow->work);
        settled = true;
        for (int which = 0; which < 2; which++) {
            double before = found[which].rate;
            if (before == 0.0)
                continue;
            double sensitivity =
                isinf(before) ? 1.0 : yield_rate_sensitivity(stated[which], before);
            double rate =
                SHARE * pow(sensitivity * deepest.springs, POWER) * blow->speed / deepest.radius;
            found[which].rate = rate;
            found[which].factor = fmin(yield_rate_factor(stated[which], rate),
                                       materials[which]->young / materials[which]->yield);
            raised[which].yield = found[which].factor * materials[which]->yield;
            settled = settled && fabs(rate - before) <= FOUND * rate;
        }
    }
}
