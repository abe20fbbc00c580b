/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An item of a job that takes long while others wait: a job by itself, for workers who take their
 * time. */
#ifndef PERCUSS_DAEMON_ERRAND_H
#define PERCUSS_DAEMON_ERRAND_H

#include "daemon/queue.h"

/* Passes an item that was given up on to another queue; what cannot be passed on, as that is full,
 * is refused. ENDED: with that the job has ended. */
enum job_end errand_send(struct job *job, size_t item, struct queue *queue);

#endif
