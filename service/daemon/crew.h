/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Several threads of low priority that work through numbered items together. */
#ifndef PERCUSS_DAEMON_CREW_H
#define PERCUSS_DAEMON_CREW_H

#include <stdbool.h>
#include <stdint.h>

/* Works on one item; `member` is the thread's number, 0 .. members - 1. False: it was given up, as
 * the watch has said to stop. */
typedef bool crew_work(void *context, unsigned member, uint64_t item);

/* Called by the waiting thread about ten times a second with the number of items from the first on
 * that are all done. False: stop. */
typedef bool crew_watch(void *context, uint64_t done);

struct crew_job {
    unsigned members;
    uint64_t first, end; /* items first .. end - 1 */
    crew_work *work;
    crew_watch *watch;
    void *context; /* of both */
};

/* Starts the threads, waits for their end and returns how far all items are done: `end` unless it
 * was stopped, or no thread could be started. */
uint64_t crew_run(const struct crew_job *job);

#endif
