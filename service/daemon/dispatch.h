/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the reading thread does with every sample: repeats, refuses, answers on the spot or queues.
 */
#ifndef PERCUSS_DAEMON_DISPATCH_H
#define PERCUSS_DAEMON_DISPATCH_H

#include "daemon/shared.h"

/* What the reading thread keeps for itself. */
struct dispatch;

struct dispatch *dispatch_create(struct shared *shared); /* NULL: out of memory */
void dispatch_free(struct dispatch *dispatch);           /* NULL is allowed */

/* The callbacks for endpoint_run. */
struct endpoint_handler dispatch_handler(struct dispatch *dispatch);

#endif
