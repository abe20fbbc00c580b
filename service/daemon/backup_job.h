/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The store looked through and copied, in its turn among the requests of specimens. */
#ifndef PERCUSS_DAEMON_BACKUP_JOB_H
#define PERCUSS_DAEMON_BACKUP_JOB_H

#include "daemon/job.h"
#include "daemon/shared.h"

/* A job for the specimens' lane, which nobody gets a reply to. NULL: out of memory. */
struct job *backup_job_create(struct shared *shared);

#endif
