/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One ensemble answered, with progress on the wire. */
#ifndef PERCUSS_DAEMON_ENSEMBLE_RUN_H
#define PERCUSS_DAEMON_ENSEMBLE_RUN_H

#include "daemon/client_job.h"

/* The reply, whatever it says; NULL: out of memory. It ends early, with the samples solved so far,
 * when `entry` is cancelled or its deadline passes, and without any when its client is gone: the
 * job is abandoned then. */
struct answer *ensemble_run(struct client_job *job, struct ensemble_entry *entry,
                            const percuss_v1_EnsembleRequest *request);

#endif
