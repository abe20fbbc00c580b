/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whoever waits for what may take long, and how often he is asked. The solver has no clock: whoever
 * is asked may have one. */
#ifndef PERCUSS_BASE_WATCH_H
#define PERCUSS_BASE_WATCH_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"

/* Told the part done, 0 ... 1 (0 where nobody knows), now and then; false stops it. What is solved
 * to its end does not depend on it. */
struct watch {
    bool (*proceed)(void *context, double done); /* NULL: nobody objects */
    void *context;
};

/* Asks a watch once in so much work: the modes of a contact step or an interval of a flight, some
 * 20 ns each, are the unit, see impact/impact_scale.h. */
struct pace {
    const struct watch *watch; /* borrowed */
    double work;               /* since it was asked */
    bool stopped;              /* for good */
};

/* About a millisecond. */
static const double PACE_WORK = 5e4;

/* Asks at once. False: stop. `pace` may be NULL here and below: nobody waits. */
bool pace_ask(struct pace *pace, double done);

/* Counts work that is about to be done. False: stop. */
static inline bool pace_keeps(struct pace *pace, double work)
{
    if (!pace)
        return true;
    pace->work += work;
    return pace->work < PACE_WORK || pace_ask(pace, 0.0);
}

/* PERCUSS_TIMEOUT once it has been stopped; PERCUSS_OK before. */
static inline enum percuss_status pace_status(const struct pace *pace)
{
    return pace && pace->stopped ? PERCUSS_TIMEOUT : PERCUSS_OK;
}

/* The message of a failure that has none of its own: TIMEOUT was stopped, any other but OK had no
 * memory. Returns the status. */
enum percuss_status pace_fault(struct fault *fault, enum percuss_status status);

#endif
