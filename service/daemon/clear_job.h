/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A specimen to be forgotten, in its turn among the requests. */
#ifndef PERCUSS_DAEMON_CLEAR_JOB_H
#define PERCUSS_DAEMON_CLEAR_JOB_H

#include "daemon/job.h"
#include "daemon/shared.h"

/* A job for the specimens' lane, which nobody gets a reply to. NULL: out of memory. */
struct job *clear_job_create(struct shared *shared, const char *specimen);

#endif
