/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_limits.h"

#include <math.h>

/* omega h up to which a step of four nodes resolves a mode. */
static const double RESOLVED = 4.0;

/* Factors of accuracy^(2/5), of ^(1/2) twice and of ^(1/5): with them the steps of a contact leave
 * some 0.1 accuracy^0.8 in the restitution (docs/accuracy.md, error.restitution_time). Single
 * impacts bear six times larger EVENT and OPENING; sequences then are met and wrong three times as
 * often. */
static const double ROUGHNESS = 0.6;
static const double EVENT = 1.5;
static const double OPENING = 4.0;
static const double COUPLING = 3.2;

/* For any accuracy: a force is a cubic to 2 %, a contact has some ten steps, of which the last is a
 * sixtieth of it, and the audit closes (see the header). */
static const double ROUGHEST = 0.02;
static const double LONGEST_EVENT = 0.05;
static const double LONGEST_OPENING = 0.5;
static const double CLOSEST = 0.25;

struct step_limits step_limits_make(double accuracy)
{
    double root = pow(accuracy, 0.2);
    return (struct step_limits){
        .roughness = fmin(ROUGHEST, ROUGHNESS * root * root),
        .event_share = fmin(LONGEST_EVENT, EVENT * sqrt(accuracy)),
        .opening_share = fmin(LONGEST_OPENING, OPENING * sqrt(accuracy)),
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
