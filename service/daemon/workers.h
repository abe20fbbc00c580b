/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The threads that answer what is queued. */
#ifndef PERCUSS_DAEMON_WORKERS_H
#define PERCUSS_DAEMON_WORKERS_H

#include "daemon/service.h"

/* Starts settings->workers threads for the short lane, one for the long one, and one for specimens
 * if there is a store. False: not all of them could be started; workers_join ends those that run.
 */
bool workers_start(struct service *service);

/* Waits for their end, which comes when the queues are closed and empty. */
void workers_join(struct service *service);

#endif
