/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether a thread still moves: it gives signs of life while it works, and others look how long ago
 * the last one was. */
#ifndef PERCUSS_DAEMON_PULSE_H
#define PERCUSS_DAEMON_PULSE_H

#include <stdatomic.h>

/* Of one thread; others only look. Zeroed: it rests. */
struct pulse {
    _Atomic double last; /* monotonic, s; 0: it waits for work */
};

/* From now on that pulse is the calling thread's. It must outlive the thread. */
void pulse_adopt(struct pulse *pulse);

/* The calling thread moves; nothing where it has no pulse. About 30 ns. */
void pulse_beat(void);

/* The calling thread has nothing to do. */
void pulse_rest(void);

/* Seconds since it last moved; 0 while it rests. Any thread. */
double pulse_silence(const struct pulse *pulse, double now);

#endif
