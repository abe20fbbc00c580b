/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Work in items that a pool of workers runs, whatever it is about. */
#ifndef PERCUSS_DAEMON_JOB_H
#define PERCUSS_DAEMON_JOB_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/queue.h>

struct job;
struct responder;

/* What jobs of a kind do. */
struct job_kind {
    /* Does one item. Several threads may do several items at once, each with its own responder. */
    void (*run)(struct job *job, size_t item, struct responder *responder);
    /* All items are done: tells whoever waits, if anybody does. */
    void (*report)(struct job *job);
    /* What is left of it is to be given up soon. Any thread, at any time. NULL: it takes no time.
     */
    void (*cancel)(struct job *job);
    /* Frees the job, whether it has run or not. */
    void (*release)(struct job *job);
};

/* The first member of every job. */
struct job {
    const struct job_kind *kind;
    size_t items;       /* >= 1 */
    atomic_size_t left; /* items that are not done */
    /* the queue's, under its lock */
    size_t next; /* first item no worker has taken */
    LIST_ENTRY(job) live;
};

void job_init(struct job *job, const struct job_kind *kind, size_t items);

/* Does an item. True: it was the last one, and the job has been reported and is to be released. */
bool job_run(struct job *job, size_t item, struct responder *responder);

#endif
