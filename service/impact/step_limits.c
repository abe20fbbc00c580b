/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_limits.h"

#include <math.h>

/* omega h up to which a step resolves a mode. */
static const double RESOLVED = 4.0;

struct step_limits step_limits_make(double accuracy)
{
    double power = pow(accuracy, 0.2);
    return (struct step_limits){
        .roughness = fmin(0.02, 0.6 * power * power),
        .event_share = fmin(0.05, 0.5 * power * power),
        .coupling = fmin(0.25, 3.2 * power),
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
        double largest = 0.0;
        for (size_t k = 0; k < group->count; k++)
            largest = fmax(largest, phi[k] * phi[k]);
        double coupled = sqrt(RESOLVED * coupling / (largest * stiffness));
        double resolved = RESOLVED / group->set->omega[group->count - 1];
        longest = fmin(longest, fmax(coupled, resolved));
    }
    return longest;
}
