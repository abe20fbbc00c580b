/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "base/watch.h"

bool pace_ask(struct pace *pace, double done)
{
    if (!pace)
        return true;
    const struct watch *watch = pace->watch;
    if (!pace->stopped && watch && watch->proceed)
        pace->stopped = !watch->proceed(watch->context, done);
    /* once stopped, the next count of work asks again and gets the same answer */
    pace->work = pace->stopped ? PACE_WORK : 0.0;
    return !pace->stopped;
}

enum percuss_status pace_fault(struct fault *fault, enum percuss_status status)
{
    if (status == PERCUSS_OK)
        return status;
    return fault_set(fault, status,
                     status == PERCUSS_TIMEOUT ? "stopped before the end" : "out of memory");
}
