/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the daemon's responders answer by. */
#ifndef PERCUSS_DAEMON_MEANS_H
#define PERCUSS_DAEMON_MEANS_H

#include "daemon/shared.h"
#include "respond/responder.h"

/* A responder for a lane; only in that of tables those that are missing are computed when a request
 * insists on them, which takes seconds to minutes. NULL: out of memory. */
struct responder *means_responder(struct shared *shared, enum lane lane);

/* For struct table_wait with `shared` as the context: tells the status how far a table is, and
 * whether somebody waits for it. */
enum percuss_status means_table_goes_on(void *shared, const struct table_maker *maker, double done,
                                        struct fault *fault);
void means_table_ended(void *shared, const struct table_maker *maker);

#endif
