/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble that a client asks for: decoded, its samples solved by several threads with progress
 * on the wire, and reported. It ends early, with the samples solved so far, when it is cancelled or
 * its deadline passes; without a reply when its client is gone. */
#ifndef PERCUSS_DAEMON_ENSEMBLE_JOB_H
#define PERCUSS_DAEMON_ENSEMBLE_JOB_H

#include "daemon/client_job.h"

/* A job for a copy of the request, among shared->ensembles until it is released. NULL: out of
 * memory. */
struct client_job *ensemble_job_create(struct shared *shared, const struct request_name *name,
                                       const percuss_v1_EnsembleRequest *request, double arrival);

#endif
