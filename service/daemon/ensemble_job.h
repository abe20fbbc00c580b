/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One ensemble answered: decoded, its samples solved by several threads with progress on the wire,
 * and reported. */
#ifndef PERCUSS_DAEMON_ENSEMBLE_JOB_H
#define PERCUSS_DAEMON_ENSEMBLE_JOB_H

#include "daemon/service.h"

/* The reply, whatever it says. It ends early, with the samples solved so far, when it is cancelled
 * or its deadline passes; without a reply (NULL, the job is abandoned then) when its client is
 * gone. NULL otherwise: out of memory. */
struct answer *ensemble_respond(struct service *service, struct job *job);

#endif
