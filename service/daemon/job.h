/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Work in items that a pool of workers runs, whatever it is about. */
#ifndef PERCUSS_DAEMON_JOB_H
#define PERCUSS_DAEMON_JOB_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/queue.h>

#include "base/hash.h"

struct job;
struct queue;
struct request_name;
struct responder;
struct task;

/* What jobs of a kind do. */
struct job_kind {
    /* Does one item. Several threads may do several items at once, each with its own responder.
     * False: it takes long while others wait, and was given up, to be done from its beginning by
     * those who take their time (errand.h). */
    bool (*run)(struct job *job, size_t item, struct responder *responder);
    /* Does not do one item, since too much waits: its answer is to say so. */
    void (*refuse)(struct job *job, size_t item);
    /* All items are done: tells whoever waits, if anybody does. */
    void (*report)(struct job *job);
    /* What is left of it is to be given up soon. Any thread, at any time. NULL: it takes no time.
     */
    void (*cancel)(struct job *job);
    /* Frees the job, whether it has run or not. */
    void (*release)(struct job *job);
    /* What it is about; false: nobody waits for it any more. Any thread, as long as the job is in a
     * queue or being done. NULL: nobody wants to know. */
    bool (*describe)(const struct job *job, struct task *task);
    /* Whether it is the request of that name, whose client does not wait for it any more: it gets
     * no reply, and what is left of it is given up soon. As `describe`. NULL: it is nobody's. */
    bool (*withdraw)(struct job *job, const struct request_name *name);
};

/* The first member of every job. */
struct job {
    const struct job_kind *kind;
    size_t items;        /* >= 1 */
    atomic_size_t left;  /* items that are not done */
    struct digest owner; /* the client whose turn it takes; zero: nobody's */
    /* the queue's, under its lock */
    struct queue *queue; /* that it was put into */
    size_t next;         /* first item no worker has taken */
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

/* Refuses an item: GOES_ON or ENDED. */
enum job_end job_refuse_item(struct job *job, size_t item);

/* Refuses a job that has not begun, and releases it. */
void job_refuse(struct job *job);

#endif
