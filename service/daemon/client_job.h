/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Jobs that a client waits for: who asked what and when, and how he hears of it. */
#ifndef PERCUSS_DAEMON_CLIENT_JOB_H
#define PERCUSS_DAEMON_CLIENT_JOB_H

#include <stdbool.h>

#include "daemon/job.h"
#include "daemon/shared.h"
#include "daemon/task.h"

/* How it ends for its client, once. */
enum client_job_fate { FATE_OPEN, FATE_DELIVERED, FATE_WITHDRAWN };

/* All but the last four members stays as it was begun. */
struct client_job {
    struct job job;
    struct shared *shared;
    enum lane lane; /* whose workers do it: set by its kind */
    uint8_t client[16];
    struct request_name name;  /* of that client */
    double arrival;            /* monotonic, s */
    struct snapshot *snapshot; /* it is answered from, held */
    atomic_bool abandoned;     /* its client was found gone */
    atomic_int fate;           /* enum client_job_fate */
    atomic_uint running;       /* items that are being done */
    _Atomic double done;       /* share of the item at hand; 0: nobody knows */
};

/* Begins a job on the present snapshot; `name` is copied. */
void client_job_begin(struct client_job *job, struct shared *shared,
                      const struct request_name *name, double arrival);
void client_job_end(struct client_job *job);

/* The head of its reply. */
struct envelope client_job_envelope(const struct client_job *job);

/* Whether its client has gone by now, which is noted as abandoned. */
bool client_job_is_gone(struct client_job *job);

/* Delivers its reply (NULL: there was no memory for one), which stays the caller's; a client that
 * has gone gets none, one that has come back is told. */
void client_job_deliver(struct client_job *job, struct answer *answer);

/* Whether its client has said that he does not wait for it. */
bool client_job_is_withdrawn(const struct client_job *job);

/* As job_kind.withdraw: from now on the request is as if it had never been asked. */
bool client_job_withdraw(struct job *job, const struct request_name *name);

/* What it is about, as a task of that kind; false: it was withdrawn. */
bool client_job_describe(const struct client_job *job, uint32_t kind, struct task *task);

#endif
