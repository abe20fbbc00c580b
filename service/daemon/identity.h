/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How long the identity of a secured daemon holds: its log says so in the last 30 days. */
#ifndef PERCUSS_DAEMON_IDENTITY_H
#define PERCUSS_DAEMON_IDENTITY_H

#include <time.h>

#include "wire_validity.h"

/* The main thread's; zeroed: none. */
struct identity {
    const char *folder; /* borrowed; NULL: not secured */
    struct wire_validity validity;
    double looked; /* when it was looked at last; monotonic, s */
    bool ended;    /* as it was then */
};

/* Reads what stands in the folder, which DDS reads once, too. `folder`: NULL: none. */
void identity_read(struct identity *identity, const char *folder);

/* Warns when it is about to end or has ended, once a day and at the end: `now` is monotonic, `then`
 * the time of day. */
void identity_look(struct identity *identity, double now, time_t then);

#endif
