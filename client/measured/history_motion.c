/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "history_motion.h"

#include <stdlib.h>

/* By trapezoids, 0 at time 0 (between two readings: by the line through them). */
static void integrate(const struct history_motion *motion, const double *velocity,
                      double *displacement)
{
    const double *time = motion->time;
    double at_zero = 0.0;
    for (size_t i = 1; i < motion->count; i++) {
        double step = 0.5 * (velocity[i - 1] + velocity[i]) * (time[i] - time[i - 1]);
        displacement[i] = displacement[i - 1] + step;
        if (time[i - 1] <= 0.0 && time[i] > 0.0)
            at_zero = displacement[i - 1] - step * time[i - 1] / (time[i] - time[i - 1]);
    }
    for (size_t i = 0; i < motion->count; i++)
        displacement[i] -= at_zero;
}

bool history_align(const struct history *history, const struct history_impacts *impacts,
                   struct history_motion *motion)
{
    const bool of_b = history->of_b;
    const double *measured[2] = {of_b ? NULL : history->velocity_a,
                                 of_b ? history->velocity_a : history->velocity_b};
    double start = impacts->list[0].start;
    /* the contact pushes B the other way */
    double sign = of_b ? -impacts->direction : impacts->direction;
    size_t count = history->count;
    *motion = (struct history_motion){.count = count, .time = calloc(count, sizeof(double))};
    bool good = motion->time;
    /* from the first touch on */
    for (size_t i = 0; good && i < count; i++)
        motion->time[i] = history->time[i] - start;
    /* the motion of each body that was measured */
    for (int which = 0; good && which < 2; which++) {
        if (!measured[which])
            continue;
        motion->velocity[which] = calloc(count, sizeof(double));
        motion->displacement[which] = calloc(count, sizeof(double));
        good = motion->velocity[which] && motion->displacement[which];
        for (size_t i = 0; good && i < count; i++)
            motion->velocity[which][i] = sign * measured[which][i];
        if (good)
            integrate(motion, motion->velocity[which], motion->displacement[which]);
    }
    if (!good)
        history_motion_free(motion);
    return good;
}

void history_motion_free(struct history_motion *motion)
{
    free(motion->time);
    for (int which = 0; which < 2; which++) {
        free(motion->velocity[which]);
        free(motion->displacement[which]);
    }
    *motion = (struct history_motion){0};
}
