/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The status of the daemon in three forms: published on DDS, a line for the service manager, and a
 * file for a monitoring system; with the tasks that it lists, and the status of other servers. */
#ifndef PERCUSS_DAEMON_STATUS_H
#define PERCUSS_DAEMON_STATUS_H

#include "daemon/queue.h"
#include "daemon/shared.h"

/* Publishes the status. Any thread. */
void status_announce(struct shared *shared);

/* The same in a line, for the service manager. */
void status_describe(struct shared *shared, char *text, size_t size);

/* Writes counters and state in OpenMetrics text to that file: a new one beside it, which then takes
 * its place, so that no reader finds half of one. False with a fault. */
bool status_write_metrics(struct shared *shared, const char *path, struct fault *fault);

/* Bytes that are kept from one request to the next, and resident ones of the process. Any thread.
 */
size_t status_kept_bytes(struct shared *shared);
size_t status_resident_bytes(void);

enum { TASKS_LISTED = 16 };

struct tasks {
    struct task list[TASKS_LISTED]; /* those that run before those that wait, the oldest first */
    size_t count;                   /* in the list */
    uint32_t all;                   /* with those that it has no room for */
};

/* The tasks that run and wait now. No record of them is kept while requests are answered: they are
 * looked up in the queues. A task that has not begun is left out if its client has gone.
 * Any thread. */
void tasks_look(struct shared *shared, struct tasks *tasks);

/* Other servers in the domain. A second one that was started by mistake, or with another catalogue,
 * is in the log. */
enum { NEIGHBOURS_MOST = 16 }; /* further ones are not logged */

struct neighbour {
    uint8_t server[16];
    char name[128]; /* in words */
    bool alike;     /* of the same catalogue as ours */
    bool there;
};

struct neighbours {
    struct neighbour each[NEIGHBOURS_MOST];
    size_t count;
    uint32_t others; /* of all of them, logged or not, those under other ids than ours */
};

/* Logs each server that has come or gone, or has changed its catalogue, or differs from ours by
 * now. */
void neighbours_look(struct neighbours *neighbours, struct shared *shared);

#endif
