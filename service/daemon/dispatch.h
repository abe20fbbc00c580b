/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the reading thread does with every sample: repeats, refuses, answers on the spot or queues.
 */
#ifndef PERCUSS_DAEMON_DISPATCH_H
#define PERCUSS_DAEMON_DISPATCH_H

#include "daemon/service.h"

/* The callbacks; their context is the service. */
struct endpoint_handler dispatch_handler(struct service *service);

#endif
