/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Finds the next touch after a contact, or proves that vibration can cause none. Bounds, not
 * samples, scan the flight: an interval is passed only if a lower bound of the gap stays open on
 * it, so that no double root is missed. It is a power series of the slow modes, less its remainder
 * and the fast modes' amplitudes. */
#ifndef PERCUSS_IMPACT_FLIGHT_H
#define PERCUSS_IMPACT_FLIGHT_H

#include "base/watch.h"
#include "impact/motion.h"

enum flight_end {
    FLIGHT_TOUCH,    /* `contact` touches after `time` */
    FLIGHT_COMPLETE, /* from `time` on the rigid gaps exceed the vibration for good */
    FLIGHT_TIMEOUT,  /* neither within the time allowed */
    FLIGHT_LIMIT,    /* too many intervals, or stopped by the pace */
    FLIGHT_MEMORY    /* out of memory */
};

struct flight {
    struct motion probe;     /* the motion at the end of a flight found */
    double **reach, **bend;  /* [group][contact]: see flight_kernel_bounds */
    double *bound;           /* [contact]: sum of participation times amplitude */
    double *unknown;         /* [contact]: uncertainty of closing rates, m/s; created: 0 */
    size_t *followed;        /* [group]: lanes of modes in the interval's series */
    double *swing;           /* [group]: sqrt(1 - largest damping ratio) */
    bool damped;             /* amplitudes decay */
    unsigned long intervals; /* examined, since creation */
    struct pace *pace;       /* asked whether to go on; NULL (as created): none */
    double cost;             /* of an interval, in the pace's work */
};

bool flight_create(struct flight *flight, const struct scene *scene, struct arena *arena);

/* From a state without contact (every approach <= 0, or about to fall). `allowed` s at most and
 * `intervals` at most. */
enum flight_end flight_find(struct flight *flight, const struct scene *scene,
                            const struct motion *motion, double allowed, unsigned long intervals,
                            double *time, size_t *contact);

#endif
