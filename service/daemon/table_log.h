/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What becomes of contact tables, in the log. */
#ifndef PERCUSS_DAEMON_TABLE_LOG_H
#define PERCUSS_DAEMON_TABLE_LOG_H

#include "respond/table_cache.h"

extern const struct table_listener table_log;

#endif
