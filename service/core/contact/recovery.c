/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/recovery.h"

#include <float.h>
#include <math.h>

/* M = 3/4 int m(y) y^(-1/2) dy = 3/2 sqrt(y_m) (center + slope y_m/3 + bend y_m^2/5), and with the
 * form above center sqrt(y_m) (1 - t/5). */

void recovery_parabola(double center, double total, double width, double shape[3])
{
    double curved = 5.0 * (center - total / sqrt(width)); /* center t */
    shape[0] = center;
    shape[1] = -(center + curved) / width;
    shape[2] = curved / (width * width);
}

/* T - time: of a share as small as rounding both are the same number. */
static double distance_of(double fades, double time)
{
    double distance = fades - time;
    return fabs(distance) > DBL_EPSILON * time ? distance : DBL_EPSILON * time;
}

struct recovery_modes recovery_modes_make(const struct relaxation *relaxation)
{
    const struct relaxation creep = relaxation_creep(relaxation);
    struct recovery_modes modes = {.count = relaxation->count};
    for (size_t l = 0; l < modes.count; l++) {
        double norm = 0.0;
        modes.time[l] = creep.time[l];
        for (size_t i = 0; i < modes.count; i++) {
            double own = creep.time[l] / distance_of(creep.time[l], relaxation->time[i]);
            modes.mode[l][i] = own;
            modes.onto[l][i] = relaxation->share[i] * relaxation->time[i] * own;
            norm += modes.onto[l][i] * own;
        }
        for (size_t i = 0; i < modes.count; i++)
            modes.onto[l][i] /= norm;
        /* time_i m_i' = load: sum onto_i/time_i = sum share_i mode_i/norm = 1/norm */
        modes.driven[l] = modes.time[l] / norm;
    }
    return modes;
}

void recovery_modes_split(const struct recovery_modes *modes, const double terms[RELAXATION_MOST],
                          double amplitudes[RELAXATION_MOST])
{
    for (size_t l = 0; l < modes->count; l++) {
        amplitudes[l] = 0.0;
        for (size_t i = 0; i < modes->count; i++)
            amplitudes[l] += modes->onto[l][i] * terms[i];
    }
}

void recovery_modes_join(const struct recovery_modes *modes,
                         const double amplitudes[RELAXATION_MOST], double terms[RELAXATION_MOST])
{
    for (size_t i = 0; i < modes->count; i++) {
        terms[i] = 0.0;
        for (size_t l = 0; l < modes->count; l++)
            terms[i] += modes->mode[l][i] * amplitudes[l];
    }
}

void recovery_fade(struct recovery *left, const struct recovery_modes *modes, double time)
{
    for (size_t l = 0; l < modes->count; l++) {
        double kept = exp(-time / modes->time[l]);
        left->center[l] *= kept;
        left->total[l] *= kept;
    }
}

void recovery_shape(const struct recovery *left, const struct recovery_modes *modes,
                    const double kept[RELAXATION_MOST], double shape[3])
{
    double center = 0.0, total = 0.0;
    for (size_t l = 0; l < modes->count; l++) {
        center += kept[l] * left->center[l];
        total += kept[l] * left->total[l];
    }
    recovery_parabola(center, total, left->reach, shape);
}
