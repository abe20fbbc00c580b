/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Between contacts: the next touch, or the proof that vibration can cause none.
 *
 * The flight is scanned by bounds, not by samples: an interval is passed only when the approach
 * plus a bound of what the modes can add stays below zero on all of it, so that no double root is
 * missed. */
#ifndef PERCUSS_IMPACT_FLIGHT_H
#define PERCUSS_IMPACT_FLIGHT_H

#include "base/watch.h"
#include "impact/motion.h"

enum flight_end {
    FLIGHT_TOUCH,    /* `contact` touches after `time` */
    FLIGHT_COMPLETE, /* from `time` on the rigid gaps exceed the vibration for good */
    FLIGHT_TIMEOUT,  /* neither within the time allowed */
    FLIGHT_LIMIT,    /* too many intervals, or stopped by the pace */
    FLIGHT_MEMORY    /* it ran out */
};

struct flight {
    struct motion probe;
    double **amplitude;      /* [group][stride] */
    double *bound;           /* [contact]: sum of participation times amplitude */
    double *approach, *rate; /* [contact] of the probe */
    double *all_modes;       /* [contact][level]: remainder when all modes are followed */
    double *slow_modes;      /* [contact][level]: remainder when the slow ones are */
    size_t *slow_count;      /* [group][level]: how many are slow */
    bool known[STEP_LEVELS];
    unsigned long intervals; /* examined, since creation */
    struct pace *pace;       /* asked whether to go on; NULL (as created): nobody */
    double cost;             /* of an interval, in the pace's work */
};

bool flight_create(struct flight *flight, const struct scene *scene, struct arena *arena);

/* From a state without contact (every approach <= 0, or about to fall). `allowed` s at most and
 * `intervals` at most. */
enum flight_end flight_find(struct flight *flight, const struct scene *scene,
                            const struct motion *motion, double allowed, unsigned long intervals,
                            double *time, size_t *contact);

#endif
