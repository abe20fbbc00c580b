/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_limits.h"

#include <math.h>

/* omega h up to which a step of four nodes resolves a mode. */
static const double RESOLVED = 4.0;

/* Factor of accuracy^(1/5), and what the coupling is at most, so that the audit closes for any
 * accuracy (see the header). */
static const double COUPLING = 3.2;
static const double CLOSEST = 0.25;

/* What a care makes of the accuracy. */
struct care_limits {
    double roughness;      /* factor of accuracy^(2/5) */
    double event, opening; /* of accuracy^(1/2) */
    double roughest;       /* and what they come to at most: a force is a cubic to */
    double longest_event, longest_opening; /* that, shares of a contact's duration */
};

/* With these the steps of a contact leave some 0.1 accuracy^0.8 in the restitution
 * (docs/accuracy.md, error.restitution_time). A sequence's contact has some ten steps at least, of
 * which the last is a sixtieth of it; with the steps of a single blow, some six at least, sequences
 * would be met and wrong three times as often. Rough solutions of sequences of three were within
 * 3e-3 of careful ones. */
static const struct care_limits cares[IMPACT_CARES] = {
    [IMPACT_CARE_SEQUENCE] = {0.6, 1.5, 4.0, 0.02, 0.05, 0.5},
    [IMPACT_CARE_SINGLE] = {0.8, 17.0, 42.0, 0.05, 0.2, 0.7},
    [IMPACT_CARE_ROUGH] = {0.6, 20.0, 40.0, 0.1, 0.3, 0.7},
};

struct step_limits step_limits_make(double accuracy, enum impact_care care)
{
    const struct care_limits *limits = &cares[care];
    double root = pow(accuracy, 0.2);
    double half = sqrt(accuracy);
    return (struct step_limits){
        .roughness = fmin(limits->roughest, limits->roughness * root * root),
        .event_share = fmin(limits->longest_event, limits->event * half),
        .opening_share = fmin(limits->longest_opening, limits->opening * half),
        .coupling = fmin(CLOSEST, COUPLING * root),
    };
}

double step_limits_stable(const struct scene *scene, size_t contact,
                          const struct impact_scale *scale, double coupling)
{
    double stiffness;
    double longest = INFINITY;
    contact_law_force(&scene->laws[contact], scale->indentation, &stiffness);
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *phi = group->participation[contact];
        if (!phi || !group->count)
            continue;
        /* the strongest mode of the body, as if it were the slowest */
        double largest = 0.0;
        for (size_t k = 0; k < group->count; k++)
            largest = phi[k] * phi[k] > largest ? phi[k] * phi[k] : largest;
        /* phi^2 (dF/dd) h/omega <= coupling with omega = RESOLVED/h; or a step that resolves all */
        double coupled = sqrt(RESOLVED * coupling / (largest * stiffness));
        double resolved = RESOLVED / group->set->omega[group->count - 1];
        longest = fmin(longest, fmax(coupled, resolved));
    }
    return longest;
}
