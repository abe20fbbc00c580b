/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/pulse.h"

#include <math.h>
#include <stddef.h>

#include "exchange/clock.h"

/* Solves ask deep inside whether they are still wanted, and know nothing of the thread they are in.
 */
static _Thread_local struct pulse *own;

static void set(double last)
{
    if (own)
        atomic_store_explicit(&own->last, last, memory_order_relaxed);
}

void pulse_adopt(struct pulse *pulse)
{
    own = pulse;
}

void pulse_beat(void)
{
    if (own)
        set(clock_now());
}

void pulse_rest(void)
{
    set(0.0);
}

double pulse_silence(const struct pulse *pulse, double now)
{
    double last = atomic_load_explicit(&pulse->last, memory_order_relaxed);
    return last > 0.0 ? fmax(0.0, now - last) : 0.0;
}
