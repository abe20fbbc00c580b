/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/scene.h"

#include <math.h>

#include "base/extremes.h"

enum percuss_status scene_prepare(const struct scene *scene, int level, struct pace *pace)
{
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        enum percuss_status status = oscillators_prepare(group->set, group->count, level, pace);
        if (status != PERCUSS_OK)
            return status;
    }
    return PERCUSS_OK;
}

bool scene_is_lossy(const struct scene *scene)
{
    for (size_t c = 0; c < scene->contacts; c++)
        if (scene->laws[c].operations->lossy)
            return true;
    return false;
}

bool scene_normals(const struct scene *scene, struct arena *arena, struct scene *normals)
{
    size_t n = scene->contacts, rows = scene->rows;
    *normals = *scene;
    scene_set_frictions(normals, 0);
    normals->friction = NULL;
    if (rows == n)
        return true;
    double *w = arena_take(arena, n * n, sizeof *w);
    double *residual = arena_take(arena, n * n, sizeof *residual);
    if (!w || !residual)
        return false;
    for (size_t a = 0; a < n; a++)
        for (size_t b = 0; b < n; b++) {
            w[a * n + b] = scene->w[a * rows + b];
            residual[a * n + b] = scene->residual[a * rows + b];
        }
    normals->w = w;
    normals->residual = residual;
    return true;
}

double scene_highest_frequency(const struct scene *scene)
{
    double highest = 0.0;
    for (size_t g = 0; g < scene->groups; g++)
        if (scene->group[g].count)
            highest = larger(highest, scene->group[g].set->omega[scene->group[g].count - 1]);
    return highest;
}

double scene_longest_period(const struct scene *scene)
{
    double lowest = INFINITY;
    for (size_t g = 0; g < scene->groups; g++)
        if (scene->group[g].count)
            lowest = smaller(lowest, scene->group[g].set->omega[0]);
    return isfinite(lowest) ? 2.0 * M_PI / lowest : 0.0;
}
