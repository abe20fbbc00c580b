/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/fewer.h"

#include <math.h>
#include <string.h>

/* What leaving out mode k does to the impulse of a contact, as a part of that of compression: its
 * response to a slow force lacks inertia and viscosity (struct omitted in assembly.h). */
static double effect(const struct problem *problem, const struct impact_outcome *answer,
                     const struct scene_group *group, size_t k, size_t contact)
{
    const struct track *track = &answer->tracks[contact];
    double compression = problem->impulse_compression[contact];
    double omega = group->set->omega[k];
    double share = group->participation[contact][k] / omega;
    double inertia = share * share / (omega * omega) * track->inertia;
    double viscosity = 2.0 * group->set->damping[k] * share * share / omega * track->viscosity;
    double rate = compression * problem->w[contact * (problem->contact_count + 1)];
    return compression > 0.0 ? (fabs(inertia) + viscosity / rate) / compression : 0.0;
}

/* How many modes of a group stay: whole lanes. */
static size_t count_left(const struct problem *problem, const struct impact_outcome *answer,
                         const struct scene_group *group, double allowed)
{
    double sum[PERCUSS_MAX_CONTACTS] = {0.0};
    if (group->q || group->v)
        return group->count;
    for (size_t left = group->count; left > 0; left--)
        for (size_t c = 0; c < problem->contact_count; c++) {
            if (!group->participation[c])
                continue;
            sum[c] += effect(problem, answer, group, left - 1, c);
            if (sum[c] > allowed)
                return (left + LANES - 1) / LANES * LANES;
        }
    return 0;
}

bool fewer_modes(const struct problem *problem, const struct scene *scene,
                 const struct impact_outcome *answer, double allowed, struct scene *fewer)
{
    size_t n = scene->contacts;
    double *residual = arena_take(problem->arena, n * n, sizeof *residual);
    *fewer = *scene;
    fewer->group = arena_take(problem->arena, scene->groups, sizeof *fewer->group);
    if (!residual || !fewer->group)
        return false;
    memcpy(residual, scene->residual, n * n * sizeof *residual);
    fewer->residual = residual;
    fewer->groups = 0;
    for (size_t g = 0; g < scene->groups; g++) {
        /* each group takes its part of what is allowed */
        const struct scene_group *group = &scene->group[g];
        size_t left = count_left(problem, answer, group, allowed / (double)scene->groups);
        for (size_t k = left; k < group->count; k++) {
            double flexibility = 1.0 / (group->set->omega[k] * group->set->omega[k]);
            for (size_t i = 0; i < n * n; i++) {
                const double *a = group->participation[i / n];
                const double *b = group->participation[i % n];
                if (a && b)
                    residual[i] += a[k] * b[k] * flexibility;
            }
        }
        if (left == 0)
            continue;
        fewer->group[fewer->groups] = *group;
        if (left < group->count)
            fewer->group[fewer->groups].count = fewer->group[fewer->groups].stride = left;
        fewer->groups++;
    }
    return true;
}
