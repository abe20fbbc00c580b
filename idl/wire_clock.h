/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Steps of the time of day, which threads of Cyclone DDS 0.10.2 wait by. The thread that announces
 * the participant, renews its lease, and acknowledges what came, sleeps until a time of day that it
 * takes when it goes to sleep (ddsrt_cond_waitfor): set back by hours meanwhile, it sleeps for
 * hours, and nothing that is due later than what it sleeps for wakes it. So does the one that
 * notices that others' leases are over. Cyclone DDS 11 waits by the monotonic clock. */
#ifndef PERCUSS_WIRE_CLOCK_H
#define PERCUSS_WIRE_CLOCK_H

#include <dds/dds.h>
#include <stdbool.h>

/* One thread's. */
struct wire_clock {
    double ahead; /* of the monotonic clock, s: the time of day when it was looked at last */
};

struct wire_clock wire_clock_start(void);

/* By how many seconds the time of day was set since the last look: < 0: back. */
double wire_clock_step(struct wire_clock *clock);

/* Whether a step is one back for which threads may oversleep. */
bool wire_clock_is_back(double step);

/* Wakes those threads; what they do next they do by the new time. Another writer like this one,
 * which is a reliable one, is made and deleted: that takes both. */
void wire_clock_rouse(dds_entity_t writer);

#endif
