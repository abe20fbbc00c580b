/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The impacts that a history shows, and their sub-impacts. */
#ifndef PERCUSS_MEASURED_HISTORY_IMPACTS_H
#define PERCUSS_MEASURED_HISTORY_IMPACTS_H

#include "history.h"

struct history_sub_impact {
    double start, end; /* s */
    double jump;       /* of A's velocity, m/s */
    double approach;   /* velocity of A until it, of B taken off, m/s: < 0 */
    bool begins;       /* an impact: the first, and those that gravity brings A back to */
    double doubt;      /* of one that begins: half of the 95 % interval of the sum of its jumps over
                          its approach, as a share of that */
};

struct history_impacts {
    size_t count;
    struct history_sub_impact list[HISTORY_SUB_IMPACTS];
    double before;       /* the first one's approach, m/s */
    double acceleration; /* of A between contacts, m/s^2, as the instrument counts; 0: even */
    double direction;    /* +1, or -1 where the instrument counts the approach positive */
    bool of_b;           /* as the history's */
    double noise;        /* standard deviation of one velocity reading, m/s */
};

/* Finds sub-impacts as jumps of A's velocity that stand out of the noise: a rigid body moves evenly
 * between contacts or, where that stands out of the noise too, with one acceleration, fitted to all
 * flights; of displacements the flights are parabolas. Starts and ends are extrapolated with the
 * 5/2 power of time by which a Hertz contact begins to change a velocity. Directions may be either
 * way round. False with the reason: too few readings, no jump, no readings before the first,
 * flights that are no such motion, or fall by another gravity than the stated one. Of an
 * acceleration, and of B alone, no approach is known: 0. */
bool history_find(const struct history *history, struct history_impacts *impacts,
                  struct measured_fault *fault);

#endif
