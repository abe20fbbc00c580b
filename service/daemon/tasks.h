/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What runs and waits in the daemon: nothing is noted for it while requests are answered, it is
 * looked up in the queues. */
#ifndef PERCUSS_DAEMON_TASKS_H
#define PERCUSS_DAEMON_TASKS_H

#include "daemon/shared.h"
#include "daemon/task.h"

enum { TASKS_LISTED = 16 };

struct tasks {
    struct task list[TASKS_LISTED]; /* those that run before those that wait, the oldest first */
    size_t count;                   /* in the list */
    uint32_t all;                   /* with those that it has no room for */
};

/* What runs and waits now. What was asked by a client who has gone, and has not begun, is nobody's
 * any more and is left out. Any thread. */
void tasks_look(struct shared *shared, struct tasks *tasks);

#endif
