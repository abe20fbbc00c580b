/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What clients hear of an ensemble beside its reply. */
#ifndef PERCUSS_DAEMON_ENSEMBLE_PUBLISH_H
#define PERCUSS_DAEMON_ENSEMBLE_PUBLISH_H

#include "daemon/shared.h"
#include "ensemble/report.h"

/* How far it is: `done` of `samples`, which say `progress` (NULL: nothing yet). */
void ensemble_publish_progress(struct shared *shared, const struct ensemble_entry *entry,
                               uint64_t done, uint64_t samples,
                               const struct report_progress *progress);

/* Those that wait for their turn hear that the server is there. */
void ensemble_publish_waiting(struct shared *shared);

/* The first `done` samples for the client to list. False: out of memory. */
bool ensemble_publish_samples(struct shared *shared, const struct ensemble_entry *entry,
                              const struct ensemble *ensemble,
                              const struct ensemble_sample *samples, uint64_t done);

#endif
