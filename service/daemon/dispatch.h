/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The reading thread's work on each sample: it repeats a stored reply, refuses, answers or queues.
 */
#ifndef PERCUSS_DAEMON_DISPATCH_H
#define PERCUSS_DAEMON_DISPATCH_H

#include "daemon/shared.h"

/* Of the reading thread alone. */
struct dispatch;

struct dispatch *dispatch_create(struct shared *shared); /* NULL: out of memory */
void dispatch_free(struct dispatch *dispatch);           /* NULL is allowed */

/* The callbacks for endpoint_run. */
struct endpoint_handler dispatch_handler(struct dispatch *dispatch);

#endif
