/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request, or a batch of them, that waits for workers. */
#ifndef PERCUSS_DAEMON_JOB_H
#define PERCUSS_DAEMON_JOB_H

#include <stdatomic.h>
#include <stdbool.h>
#include <sys/queue.h>

#include "daemon/snapshot.h"
#include "endpoint/answer.h"

struct job {
    enum exchange exchange;
    uint8_t client[16];
    uint64_t sequence;
    double arrival; /* monotonic, s */
    struct snapshot *snapshot;
    percuss_v1_Request *requests; /* copies; one, or the members of a batch */
    size_t count;
    size_t next;             /* first request no worker has taken; the queue's */
    atomic_size_t left;      /* to be answered; whoever answers the last one sends the reply */
    struct answer **answers; /* of the requests */
    atomic_bool abandoned;   /* nobody waits for the reply any more */
    percuss_v1_EnsembleRequest *ensemble; /* a copy whose scene is requests[0]; NULL: none */
    atomic_bool cancelled;                /* its client wants no more samples */
    LIST_ENTRY(job) ensembles;
    char clears[PERCUSS_ID_SIZE]; /* no request: a specimen to be forgotten; empty: a request */
};

/* A job for copies of `count` >= 1 requests; client, sequence, arrival and snapshot are the
 * caller's to set. NULL: out of memory. */
struct job *job_create(enum exchange exchange, const percuss_v1_Request *requests, size_t count);

/* A job for a copy of an ensemble, likewise. */
struct job *job_create_ensemble(const percuss_v1_EnsembleRequest *request);

/* Releases all but the snapshot. */
void job_free(struct job *job);

#endif
