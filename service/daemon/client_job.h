/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Jobs that a client waits for: the request with its client and arrival, and the delivery of its
 * reply. With the jobs for impacts: one, a batch, or one that leaves its dents on specimens. */
#ifndef PERCUSS_DAEMON_CLIENT_JOB_H
#define PERCUSS_DAEMON_CLIENT_JOB_H

#include <stdbool.h>

#include "daemon/queue.h"
#include "daemon/shared.h"

/* The end of a job for its client; it has one. */
enum client_job_fate { FATE_OPEN, FATE_DELIVERED, FATE_WITHDRAWN };

/* The base of these jobs. All but the last four members stay as they were begun. */
struct client_job {
    struct job job;
    struct shared *shared;
    enum lane lane; /* of the workers that do it: set by its kind */
    uint8_t client[16];
    struct request_name name;  /* of that client */
    double arrival;            /* monotonic, s */
    struct snapshot *snapshot; /* it is answered from, held */
    atomic_bool abandoned;     /* its client was found gone */
    atomic_int fate;           /* enum client_job_fate */
    atomic_uint running;       /* items that are being done */
    _Atomic double done;       /* share of the item at hand; 0: unknown */
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
 * has gone gets none, one that has come back gets it. */
void client_job_deliver(struct client_job *job, struct answer *answer);

/* Whether its client has said that it does not wait for the reply. */
bool client_job_is_withdrawn(const struct client_job *job);

/* As job_kind.withdraw: from now on the request is as if it had never been sent. */
bool client_job_withdraw(struct job *job, const struct request_name *name);

/* Fills a task of that kind; false: the job was withdrawn. */
bool client_job_describe(const struct client_job *job, uint32_t kind, struct task *task);

/* A job for copies of `count` >= 1 requests, as a batch if `name` is one. NULL: out of memory. */
struct client_job *impact_job_create(struct shared *shared, const struct request_name *name,
                                     const percuss_v1_Request *requests, size_t count,
                                     double arrival);

/* Whether a request is for the specimens' lane. */
bool impact_job_is_durable(const struct shared *shared, const percuss_v1_Request *request);

/* Some 0.02 to 0.5 ms with a warm workspace: the reading thread may solve it. */
bool impact_job_is_cheap(const percuss_v1_Request *request);

/* Perhaps seconds: it is for the long lane. */
bool impact_job_is_long(const percuss_v1_Options *options);

#endif
