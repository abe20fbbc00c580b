/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a job is about, for whoever looks at what the daemon does. */
#ifndef PERCUSS_DAEMON_TASK_H
#define PERCUSS_DAEMON_TASK_H

#include <stdbool.h>
#include <stdint.h>

struct task {
    uint8_t client[16]; /* who waits for it; zeros: nobody */
    uint64_t sequence;
    uint32_t kind;  /* percuss_v1_TASK_... */
    bool running;   /* false: it waits */
    double arrival; /* monotonic, s */
    double done;    /* share of it, 0..1; NAN: nobody knows */
};

#endif
