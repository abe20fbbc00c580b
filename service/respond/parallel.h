/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Several threads that work through numbered items together. */
#ifndef PERCUSS_RESPOND_PARALLEL_H
#define PERCUSS_RESPOND_PARALLEL_H

#include <stdbool.h>
#include <stdint.h>

/* Works on one item; `thread` is its number, 0 .. threads - 1. False: it was given up, as
 * the watch has said to stop. */
typedef bool parallel_work(void *context, unsigned thread, uint64_t item);

/* Called by the waiting thread about ten times a second with the number of items from the first on
 * that are all done. False: stop. */
typedef bool parallel_watch(void *context, uint64_t done);

struct parallel_loop {
    unsigned threads;
    uint64_t first, end; /* items first .. end - 1 */
    parallel_work *work;
    parallel_watch *watch;
    void *context; /* of both */
    int nice;      /* of the threads; 0: as the caller */
};

/* Starts the threads, waits for their end and returns how far all items are done: `end` unless it
 * was stopped, or no thread could be started. */
uint64_t parallel_run(const struct parallel_loop *loop);

#endif
