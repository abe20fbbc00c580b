/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The jobs that wait for workers: clients take turns, one item each; bounded, and when it is full
 * whoever has most waiting gives way. Any thread. */
#ifndef PERCUSS_DAEMON_QUEUE_H
#define PERCUSS_DAEMON_QUEUE_H

#include <stdbool.h>
#include <stddef.h>

#include "daemon/job.h"

/* For queue_create: a client may have all workers at once. */
static const size_t QUEUE_WHOLE = (size_t)-1;

struct queue;

/* For `capacity` jobs that wait, of which at most `share` items (>= 1) of one client are done at
 * once. NULL: out of memory. */
struct queue *queue_create(size_t capacity, size_t share);
void queue_free(struct queue *queue); /* must be empty */

/* False: full or closed, or no memory; the job stays the caller's. A full queue takes the job of a
 * client who has fewer waiting than another one: the last job of the one who has most of them is
 * given back in *displaced, for the caller to refuse (job_refuse); otherwise that is NULL. */
bool queue_put(struct queue *queue, struct job *job, struct job **displaced);

/* Waits for an item of a job, the caller's to do, and then to be reported by queue_done. Clients
 * take turns, and the items of a job are handed out one by one, taking turns with other jobs of its
 * client. NULL: the queue is closed and empty. */
struct job *queue_take(struct queue *queue, size_t *item);

/* An item of that owner is done, or passed on. `ended`: its job, if that has no other items left,
 * which may be released from now on; otherwise NULL. */
void queue_done(struct queue *queue, struct digest owner, struct job *ended);

/* An item of that owner was given up as it takes long. */
void queue_note_long(struct queue *queue, struct digest owner);

/* Whether an item that was taken is likely to be given up too, while others wait: it is to be
 * passed on at once. Now and then one of that owner is tried all the same. */
bool queue_is_long(struct queue *queue, const struct job *job);

/* A job that was put ends though none of its items is being done here: it was passed on. */
void queue_retire(struct job *job);

/* Whether another client than this job's waits. */
bool queue_others_wait(struct queue *queue, const struct job *job);

/* Takes no more jobs. */
void queue_close(struct queue *queue);

/* The same, and cancels the jobs that wait or are being done. */
void queue_cancel(struct queue *queue);

/* Waits until nothing is queued or being answered, at most `seconds`. False: something is. */
bool queue_drain(struct queue *queue, double seconds);

/* Tells the job of that name that its client does not wait for it any more. *withdrawn: it has not
 * begun and is the caller's to release; NULL: it has. False: there is no such job here. */
bool queue_withdraw(struct queue *queue, const struct request_name *name, struct job **withdrawn);

/* Shows each job that waits or is being done, under the queue's lock. */
void queue_visit(struct queue *queue, void (*visit)(void *context, const struct job *job),
                 void *context);

/* Number of jobs that wait. */
size_t queue_length(struct queue *queue);

#endif
