/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the server says of itself. */
#ifndef PERCUSS_DAEMON_STATUS_H
#define PERCUSS_DAEMON_STATUS_H

#include "daemon/shared.h"

/* Publishes the status. Any thread. */
void status_announce(struct shared *shared);

/* The same in a line, for whoever looks at the service manager. */
void status_describe(struct shared *shared, char *text, size_t size);

#endif
