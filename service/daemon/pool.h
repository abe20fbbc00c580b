/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The threads that do jobs. */
#ifndef PERCUSS_DAEMON_POOL_H
#define PERCUSS_DAEMON_POOL_H

#include <stdbool.h>
#include <stddef.h>

#include "daemon/queue.h"

struct responder;
struct pool;

/* A pool of at most `most` workers, none of them there yet. NULL: out of memory. */
struct pool *pool_create(size_t most);

/* Starts a worker, which does the jobs of `queue` until that is closed and empty, with `responder`,
 * which is the pool's from now on (NULL: the jobs need none). What it gives up for the others who
 * wait goes to the queue `slower` (NULL: it gives up nothing). False: the thread could not be
 * started. */
bool pool_add(struct pool *pool, struct queue *queue, struct queue *slower,
              struct responder *responder, int nice);

/* The longest time, s, since a worker that is at work last moved. Any thread that does not add
 * workers meanwhile. */
double pool_silence(const struct pool *pool);

/* Waits for the end of all workers and frees the pool. NULL is allowed. */
void pool_join(struct pool *pool);

#endif
