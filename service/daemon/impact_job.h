/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Impacts that clients ask for: one, a batch, or one that leaves its dents on specimens. */
#ifndef PERCUSS_DAEMON_IMPACT_JOB_H
#define PERCUSS_DAEMON_IMPACT_JOB_H

#include "daemon/client_job.h"

/* A job for copies of `count` >= 1 requests, as a batch if `name` is one. NULL: out of memory. */
struct client_job *impact_job_create(struct shared *shared, const struct request_name *name,
                                     const percuss_v1_Request *requests, size_t count,
                                     double arrival);

/* Whether a request is for the specimens' lane. */
bool impact_job_is_durable(const struct shared *shared, const percuss_v1_Request *request);

#endif
