/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/track.h"

#include <math.h>

bool track_create(struct track *track, struct arena *arena)
{
    track->list = arena_take(arena, PERCUSS_MAX_SUB_IMPACTS, sizeof *track->list);
    track_clear(track);
    return track->list != NULL;
}

void track_clear(struct track *track)
{
    track->count = 0;
    track->impulse = 0.0;
    track->end_time = 0.0;
}

void track_open(struct track *track, double time, double gap_rate)
{
    track->open = (struct sub_impact){
        .start = time, .compression_end = time, .end = time, .gap_rate_before = gap_rate};
}

/* Where the cubic through the nodes is largest inside the step, in the step's time; < 0: at an end.
 */
static double interior_peak(const double values[NODES])
{
    double c[NODES] = {0};
    for (int m = 0; m < NODES; m++)
        for (int j = 0; j < NODES; j++)
            c[m] += values[j] * collocation.monomial[j][m];
    /* the derivative c1 + 2 c2 s + 3 c3 s^2 falls through zero where its slope 2 (c2 + 3 c3 s) is
     * -2 root: s = (-c2 - root) / (3 c3), in the form without cancellation */
    double discriminant = c[2] * c[2] - 3.0 * c[3] * c[1];
    if (discriminant <= 0.0)
        return -1.0;
    double root = sqrt(discriminant);
    double s = c[2] < 0.0 ? c[1] / (root - c[2]) : -(c[2] + root) / (3.0 * c[3]);
    return s > 0.0 && s < 1.0 ? s : -1.0;
}

void track_step(struct track *track, double time, double h, const double indentation[NODES],
                const double force[NODES], double end_indentation)
{
    struct sub_impact *open = &track->open;
    double s = interior_peak(indentation);
    double largest = s > 0.0 ? collocation_value(indentation, s) : end_indentation;
    if (s < 0.0)
        s = 1.0;
    if (largest > open->max_indentation) {
        open->max_indentation = largest;
        open->compression_end = time + s * h;
        open->compression_impulse = open->impulse + h * collocation_integral(force, s);
    }
    for (int j = 0; j < NODES; j++)
        open->impulse += h * collocation.weight[j] * force[j];
}

void track_close(struct track *track, const struct contact_law *law, double time, double gap_rate)
{
    struct sub_impact *open = &track->open;
    double stiffness;
    open->end = time;
    open->gap_rate_after = gap_rate;
    open->peak_force = contact_law_force(law, NULL, open->max_indentation, &stiffness);
    track->impulse += open->impulse;
    track->end_time = time;
    if (track->count < PERCUSS_MAX_SUB_IMPACTS)
        track->list[track->count] = *open;
    track->count++;
}

void track_mark_negligible(struct track *track)
{
    for (size_t i = 0; i < track->count && i < PERCUSS_MAX_SUB_IMPACTS; i++)
        track->list[i].negligible = track->list[i].impulse < 0.01 * track->impulse;
}
