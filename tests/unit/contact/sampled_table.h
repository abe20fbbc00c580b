/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A table sampled from another law that yields: what a computation of the contact region would
 * deliver, with a known answer. */
#ifndef PERCUSS_TEST_SAMPLED_TABLE_H
#define PERCUSS_TEST_SAMPLED_TABLE_H

#include <math.h>

#include "contact/plastic.h"
#include "contact/law_table.h"

enum { SAMPLED_POINTS = 60, SAMPLED_BRANCHES = 12, SAMPLED_SHARES = 17 };

struct sampled_table {
    struct contact_table table;
    double indentation[SAMPLED_POINTS], force[SAMPLED_POINTS], radius[SAMPLED_POINTS];
    double largest[SAMPLED_BRANCHES], residual[SAMPLED_BRANCHES];
    double share[SAMPLED_BRANCHES][SAMPLED_SHARES];
};

/* Samples up to `range` times the yield, closer together towards the surface. */
static inline void sampled_table_make(struct sampled_table *sampled, const struct contact_law *law,
                                      double range)
{
    const struct plastic_curve *curve = law->operations->curve;
    double yield = curve->yield(law);
    double slope;
    for (int i = 0; i < SAMPLED_POINTS; i++) {
        double x = (double)i / (SAMPLED_POINTS - 1);
        double d = yield * range * x * x;
        sampled->indentation[i] = d;
        sampled->force[i] = i ? curve->force(law, d, &slope) : 0.0;
        sampled->radius[i] = i ? curve->radius(law, d) : 0.0;
    }
    for (int b = 0; b < SAMPLED_BRANCHES; b++) {
        struct contact_law used = *law;
        sampled->largest[b] = yield * pow(range, (b + 1.0) / SAMPLED_BRANCHES);
        contact_law_yield(&used, sampled->largest[b]);
        double span = contact_law_limit(&used);
        sampled->residual[b] = used.history.dent;
        for (int i = 0; i < SAMPLED_SHARES; i++)
            sampled->share[b][i] =
                contact_law_force(&used, span * i / (SAMPLED_SHARES - 1) * (1 - 1e-15), &slope) /
                used.history.max_force;
        sampled->share[b][SAMPLED_SHARES - 1] = 1.0;
    }
    sampled->table = (struct contact_table){
        .points = SAMPLED_POINTS,
        .indentation = sampled->indentation,
        .force = sampled->force,
        .contact_radius = sampled->radius,
        .yield = yield,
        .branches = SAMPLED_BRANCHES,
        .largest = sampled->largest,
        .residual = sampled->residual,
        .samples = SAMPLED_SHARES,
        .share = sampled->share[0],
        .error = 1e-3,
    };
}

#endif
