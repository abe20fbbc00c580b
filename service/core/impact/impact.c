/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/impact.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "impact/impact_scale.h"

bool impact_create(struct impact_outcome *outcome, const struct scene *scene, struct arena *arena)
{
    memset(outcome, 0, sizeof *outcome);
    outcome->tracks = arena_take(arena, scene->contacts, sizeof *outcome->tracks);
    outcome->vibration = arena_take(arena, scene->bodies, sizeof *outcome->vibration);
    outcome->laws = arena_take(arena, scene->contacts, sizeof *outcome->laws);
    if (!outcome->tracks || !outcome->vibration || !outcome->laws ||
        !motion_create(&outcome->motion, scene, arena))
        return false;
    for (size_t c = 0; c < scene->contacts; c++)
        if (!track_create(&outcome->tracks[c], arena))
            return false;
    return true;
}

void impact_begin(struct impact_outcome *outcome, const struct scene *scene)
{
    memcpy(outcome->laws, scene->laws, scene->contacts * sizeof *outcome->laws);
    outcome->group = scene->group;
    outcome->groups = scene->groups;
    outcome->steps = outcome->rejected = 0;
    outcome->plastic = outcome->relaxed = outcome->slid = outcome->sheared = 0.0;
    outcome->too_stiff = false;
    for (size_t c = 0; c < scene->contacts; c++)
        track_clear(&outcome->tracks[c]);
}

unsigned long impact_max_steps(const struct scene *scene, const struct impact_settings *settings)
{
    return (unsigned long)(larger(0.0, settings->max_work) / step_cost(scene));
}

double impact_work(const struct scene *scene, const struct impact_outcome *outcome)
{
    return (double)outcome->effort * step_cost(scene);
}
