/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_cost.h"

/* What a step costs, in modes: the modes themselves, and the equations of the contacts. */
static bool feels(const struct scene *scene, size_t a, size_t b)
{
    size_t at = a * scene->contacts + b;
    if (scene->w[at] != 0.0 || scene->residual[at] != 0.0)
        return true;
    for (size_t g = 0; g < scene->groups; g++)
        if (scene->group[g].participation[a] && scene->group[g].participation[b])
            return true;
    return false;
}

/* For contacts that have to be solved for at once, whose elimination skips what is zero: in a row
 * of spheres each feels two others, on a beam all of them. One by one they cost far less. */
double step_cost(const struct scene *scene)
{
    double n = (double)scene->contacts;
    double cost = 2.0 * n * n + 6.0 * n;
    for (size_t a = 0; a < scene->contacts; a++) {
        double felt = 0.0;
        for (size_t b = 0; b < scene->contacts; b++)
            felt += feels(scene, a, b);
        cost += 8.0 * felt * felt;
    }
    for (size_t g = 0; g < scene->groups; g++)
        cost += (double)scene->group[g].count;
    return cost;
}
