/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Cancellation of long computations: a callback of the caller, and how often it is called. The
 * solver has no clock; the callback may have one. */
#ifndef PERCUSS_BASE_WATCH_H
#define PERCUSS_BASE_WATCH_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"

/* `proceed` receives the part done, 0 ... 1 (0: unknown), from time to time; false stops the
 * computation. Results of completed computations do not depend on it. */
struct watch {
    bool (*proceed)(void *context, double done); /* NULL: never stopped */
    void *context;
};

/* Calls a watch once per PACE_WORK units of work. A unit is one mode of a contact step or of a
 * flight interval, some 20 ns, see impact/impact_scale.h. */
struct pace {
    const struct watch *watch; /* borrowed */
    double work;               /* since the last call */
    bool stopped;              /* stays true */
};

/* About a millisecond. */
static const double PACE_WORK = 5e4;

/* Calls the watch at once. False: stop. `pace` may be NULL here and below: never stopped. */
bool pace_ask(struct pace *pace, double done);

/* Counts work before it is done. False: stop. */
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

/* Writes the message of a failure that has none yet: for TIMEOUT that it was stopped, for any other
 * status but OK that memory was out. Returns the status. */
enum percuss_status pace_fault(struct fault *fault, enum percuss_status status);

#endif
