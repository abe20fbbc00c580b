/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Jobs in items that a pool of workers runs, and the queue in which they wait: one queue for each
 * client inside it, which take turns, an item each. The queue is bounded: when it is full, the
 * client with most waiting jobs gives way. Any thread. */
#ifndef PERCUSS_DAEMON_QUEUE_H
#define PERCUSS_DAEMON_QUEUE_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/queue.h>

#include "base/hash.h"

struct job;
struct queue;
struct request_name;
struct responder;

/* A job as the status lists it. */
struct task {
    uint8_t client[16]; /* that waits for it; zeros: none */
    uint64_t sequence;
    uint32_t kind;  /* percuss_v1_TASK_... */
    bool running;   /* false: it waits */
    double arrival; /* monotonic, s */
    double done;    /* share of it, 0..1; NAN: unknown */
};

/* The operations of a kind of jobs. */
struct job_kind {
    /* Does one item. Several threads may do several items at once, each with its own responder.
     * False: it takes long while others wait, and was given up, to be done from its beginning by
     * workers of a slower queue (queue_demote). */
    bool (*run)(struct job *job, size_t item, struct responder *responder);
    /* Does not do one item, since too many jobs wait: its answer is to say so. */
    void (*refuse)(struct job *job, size_t item);
    /* All items are done: sends the reply, if the job has one. */
    void (*report)(struct job *job);
    /* The rest of it is to be given up soon. Any thread, at any time. NULL: it takes no time. */
    void (*cancel)(struct job *job);
    /* Frees the job, whether it has run or not. */
    void (*release)(struct job *job);
    /* Fills the task; false: no client waits for it any more. Any thread, as long as the job is in
     * a queue or being done. NULL: it is not listed. */
    bool (*describe)(const struct job *job, struct task *task);
    /* Whether it is the request of that name. Its client does not wait for it any more: it gets no
     * reply, and the rest of it is given up soon. As `describe`. NULL: no client's request. */
    bool (*withdraw)(struct job *job, const struct request_name *name);
};

/* The first member of every job. */
struct job {
    const struct job_kind *kind;
    size_t items;        /* >= 1 */
    atomic_size_t left;  /* items that are not done */
    struct digest owner; /* the client that it takes the turns of; zero: none */
    /* the queue's, under its lock */
    struct queue *queue; /* that it was put into */
    size_t next;         /* first item that no worker has taken */
    TAILQ_ENTRY(job) waiting;
    LIST_ENTRY(job) live;
};

void job_init(struct job *job, const struct job_kind *kind, size_t items, struct digest owner);

enum job_end {
    JOB_GOES_ON,
    JOB_ENDED, /* that was the last item: the job has been reported and is to be released */
    JOB_LONG   /* the item was given up and is to be passed on */
};

/* Does an item. */
enum job_end job_run(struct job *job, size_t item, struct responder *responder);

/* Refuses a job that has not begun, and releases it. */
void job_refuse(struct job *job);

/* For queue_create: a client may have all workers at once. */
static const size_t QUEUE_WHOLE = (size_t)-1;

/* For `capacity` jobs that wait, of which at most `share` items (>= 1) of one client are done at
 * once. NULL: out of memory. */
struct queue *queue_create(size_t capacity, size_t share);
void queue_free(struct queue *queue); /* must be empty */

/* False: full or closed, or no memory; the job stays the caller's. A full queue takes the job of a
 * client that has fewer waiting jobs than another one: the last job of the client that has most of
 * them is given back in *displaced, for the caller to refuse (job_refuse); otherwise that is NULL.
 */
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

/* Passes an item that was given up on to a slower queue, as a demoted item: a job by itself. It is
 * refused where that queue is full. ENDED: with that the job has ended. */
enum job_end queue_demote(struct queue *slower, struct job *job, size_t item);

/* Whether another client than this job's waits. */
bool queue_others_wait(struct queue *queue, const struct job *job);

/* Takes no more jobs. */
void queue_close(struct queue *queue);

/* The same, and cancels the jobs that wait or are being done. */
void queue_cancel(struct queue *queue);

/* Waits until no job is queued or being done, at most `seconds`. False: some job is. */
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
