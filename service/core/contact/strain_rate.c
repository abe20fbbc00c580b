/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/strain_rate.h"

#include <math.h>

#include "contact/law_closed_form.h"
#include "contact/plastic.h"

/* Tabor's. */
static const double REPRESENTATIVE = 0.2;
/* A rate that changes by less has been found. A larger factor by f makes the rate larger by f^(1/4)
 * at most, and the factor by no more than that: each round leaves a quarter of the error. */
static const double FOUND = 1e-9;
enum { ROUNDS = 40 };

static double rate_with(const struct hertz_contact *hertz, const struct material materials[2],
                        const struct strain_rate_blow *blow)
{
    struct contact_law law = contact_law_closed_form(hertz, &materials[0], &materials[1]);
    double depth = contact_law_depth(&law, blow->work);
    double strain =
        REPRESENTATIVE * law.operations->curve->radius(&law, depth) / closed_form_radius(hertz);
    return strain * blow->speed / (M_PI_2 * depth);
}

double strain_rate_of(const struct hertz_contact *hertz, const struct material *const materials[2],
                      const struct yield_rate *const stated[2], const struct strain_rate_blow *blow,
                      double factors[2])
{
    struct material raised[2] = {*materials[0], *materials[1]};
    double rate = 0.0;
    for (int i = 0; i < ROUNDS; i++) {
        double before = rate;
        rate = rate_with(hertz, raised, blow);
        for (int which = 0; which < 2; which++) {
            /* young bounds the yield stress of whatever rate */
            factors[which] = fmax(1.0, fmin(yield_rate_factor(stated[which], rate),
                                            materials[which]->young / materials[which]->yield));
            raised[which].yield = factors[which] * materials[which]->yield;
        }
        if (fabs(rate - before) <= FOUND * rate)
            break;
    }
    return rate;
}
