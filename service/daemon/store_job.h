/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Jobs for the specimens' lane to which no client gets a reply; they take their turn among the
 * requests that name specimens. */
#ifndef PERCUSS_DAEMON_STORE_JOB_H
#define PERCUSS_DAEMON_STORE_JOB_H

#include "daemon/queue.h"
#include "daemon/shared.h"

/* Forgets a specimen. NULL: out of memory. */
struct job *clear_job_create(struct shared *shared, const char *specimen);

/* Checks the store and copies it to its backup. NULL: out of memory. */
struct job *backup_job_create(struct shared *shared);

#endif
