/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A history beside a simulated one: aligned with the first touch. */
#ifndef PERCUSS_MEASURED_HISTORY_MOTION_H
#define PERCUSS_MEASURED_HISTORY_MOTION_H

#include "history_impacts.h"

/* A history as a simulated one goes: time from the start of the first sub-impact, A approaching
 * with a negative velocity, displacements from that instant on. Arrays of `count`. */
struct history_motion {
    size_t count;
    double *time;
    double *velocity[2], *displacement[2]; /* of A, of B; NULL: not measured */
};

/* By the result of history_find; displacements are the velocities' integrals. False: out of memory.
 */
bool history_align(const struct history *history, const struct history_impacts *impacts,
                   struct history_motion *motion);

void history_motion_free(struct history_motion *motion);

#endif
