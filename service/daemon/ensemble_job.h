/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Jobs for ensembles: run by several threads, with progress and listed samples on the wire. */
#ifndef PERCUSS_DAEMON_ENSEMBLE_JOB_H
#define PERCUSS_DAEMON_ENSEMBLE_JOB_H

#include "daemon/client_job.h"

/* A job for a copy of the request, among shared->ensembles until it is released. NULL: out of
 * memory. */
struct client_job *ensemble_job_create(struct shared *shared, const struct request_name *name,
                                       const percuss_v1_EnsembleRequest *request, double arrival);

#endif
