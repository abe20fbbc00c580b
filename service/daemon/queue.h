/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The jobs that wait for workers: bounded, and full means refused. Any thread. */
#ifndef PERCUSS_DAEMON_QUEUE_H
#define PERCUSS_DAEMON_QUEUE_H

#include <stdbool.h>
#include <stddef.h>

#include "daemon/job.h"

struct queue;
struct queue *queue_create(size_t capacity); /* NULL: out of memory */
void queue_free(struct queue *queue);        /* must be empty */

/* False: full or closed, and the job stays the caller's. */
bool queue_put(struct queue *queue, struct job *job);

/* Waits for an item of a job, the caller's to do, and then to be reported by queue_done. The items
 * of a job are handed out one by one, taking turns with other jobs. NULL: the queue is closed and
 * empty. */
struct job *queue_take(struct queue *queue, size_t *item);

/* That item is done. `ended`: its job, if that has no other items left, which may be released from
 * now on; otherwise NULL. */
void queue_done(struct queue *queue, struct job *ended);

/* Takes no more jobs. */
void queue_close(struct queue *queue);

/* The same, and cancels the jobs that wait or are being done. */
void queue_cancel(struct queue *queue);

/* Waits until nothing is queued or being answered, at most `seconds`. False: something is. */
bool queue_drain(struct queue *queue, double seconds);

/* Number of jobs that wait. */
size_t queue_length(struct queue *queue);

#endif
