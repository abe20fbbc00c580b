/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Threads of the daemon: the pool of workers that do jobs, the heartbeat that shows whether a
 * thread still moves, and the memory that a thread keeps. */
#ifndef PERCUSS_DAEMON_POOL_H
#define PERCUSS_DAEMON_POOL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "daemon/queue.h"

struct responder;
struct pool;

/* The niceness of threads for solves that take long. */
enum { POOL_PATIENT_NICE = 10 };

/* A pool of at most `most` workers, none of them there yet. NULL: out of memory. */
struct pool *pool_create(size_t most);

/* Starts a worker, which does the jobs of `queue` until that is closed and empty, with `responder`,
 * which is the pool's from now on (NULL: the jobs need none). Items that it gives up for the
 * clients that wait go to the queue `slower` (NULL: it gives up none). False: the thread could not
 * be started. */
bool pool_add(struct pool *pool, struct queue *queue, struct queue *slower,
              struct responder *responder, int nice);

/* The longest time, s, since a worker that is at work last moved. Any thread that does not add
 * workers meanwhile. */
double pool_silence(const struct pool *pool);

/* Waits for the end of all workers and frees the pool. NULL is allowed. */
void pool_join(struct pool *pool);

/* The last sign of life of one thread, which others only read. Zeroed: it rests. */
struct heartbeat {
    _Atomic double last; /* monotonic, s; 0: it waits for work */
};

/* From now on that heartbeat is the calling thread's. It must outlive the thread. */
void heartbeat_adopt(struct heartbeat *heartbeat);

/* The calling thread moves; no effect where it has no heartbeat. About 30 ns. */
void heartbeat_beat(void);

/* The calling thread waits for work. */
void heartbeat_rest(void);

/* Seconds since it last moved; 0 while it rests. Any thread. */
double heartbeat_silence(const struct heartbeat *heartbeat, double now);

/* Makes the allocator keep so many bytes for the calling thread that the system has mapped already.
 * A thread's heap grows page by page otherwise, by a system call and a page fault each: two or
 * three microseconds of each of a client's first thousand requests, as their replies are kept.
 * No effect where the memory is not available. */
void memory_keep(size_t bytes);

#endif
