/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/impact.h"

#include <math.h>
#include <string.h>

#include "impact/flight_root.h"

bool impact_create(struct impact_outcome *outcome, const struct scene *scene, struct arena *arena)
{
    memset(outcome, 0, sizeof *outcome);
    outcome->tracks = arena_take(arena, scene->contacts, sizeof *outcome->tracks);
    outcome->vibration = arena_take(arena, scene->bodies, sizeof *outcome->vibration);
    if (!outcome->tracks || !outcome->vibration ||
        !motion_create(&outcome->motion, scene, arena))
        return false;
    for (size_t c = 0; c < scene->contacts; c++)
        if (!track_create(&outcome->tracks[c], arena))
            return false;
    return true;
}

void impact_find_start(const struct scene *scene, double longest, struct motion *motion,
                       double *time_shift)
{
    double shift = 0.0;
    for (size_t c = 0; c < scene->contacts; c++) {
        double d;
        double rate;
        motion_approach(motion, scene, c, &d, &rate);
        if (d <= 0.0)
            continue;
        double back = flight_root_back(motion, scene, c, longest);
        if (isfinite(back))
            shift = fmin(shift, back);
    }
    if (shift < 0.0)
        motion_advance(motion, scene, shift);
    *time_shift = shift;
}

struct impact_scale impact_scale_of(const struct scene *scene, size_t contact, double rate)
{
    const struct contact_law *law = &scene->laws[contact];
    double speed = fmax(fabs(rate), 1e-150);
    double energy = 0.5 * speed * speed / scene->w[contact * scene->contacts + contact];
    /* stored(d) = energy by bisection in log d: the stored energy of any law rises with d */
    double low = -700.0;
    double high = 50.0;
    for (int i = 0; i < 50; i++) {
        double middle = 0.5 * (low + high);
        if (law->operations->stored(law, NULL, exp(middle)) < energy)
            low = middle;
        else
            high = middle;
    }
    struct impact_scale scale = {.indentation = exp(high)};
    double stiffness;
    scale.duration = scale.indentation / speed;
    scale.force = contact_law_force(law, NULL, scale.indentation, &stiffness);
    return scale;
}
