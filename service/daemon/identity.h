/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The validity of a secured daemon's identity: the log tells it in the last 30 days. */
#ifndef PERCUSS_DAEMON_IDENTITY_H
#define PERCUSS_DAEMON_IDENTITY_H

#include <stdbool.h>
#include <stddef.h>
#include <time.h>

#include "wire_validity.h"

/* The main thread's; zeroed: none. */
struct identity {
    const char *folder; /* borrowed; NULL: not secured */
    struct wire_validity validity;
    double looked; /* time of the last look; monotonic, s */
    bool ended;    /* at that time */
};

/* Reads the validity from the folder, which DDS reads once, too. `folder`: NULL: none. */
void identity_read(struct identity *identity, const char *folder);

/* Warns when it is about to end or has ended, once a day and at the end: `now` is monotonic, `then`
 * the time of day. */
void identity_look(struct identity *identity, double now, time_t then);

/* Reads the folder's list of revoked certificates anew, and logs what it has and whom it cuts off;
 * a bad one is logged, and the last one stays. `folder`: NULL: not secured. */
void identity_revoke(const char *folder);

/* Writes a remark on an identity that is good, but not for long. False: there is none. */
bool identity_remark(const char *folder, char *remark, size_t size);

#endif
