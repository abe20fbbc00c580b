/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The file that tells a monitoring system how the daemon is, in OpenMetrics text. */
#ifndef PERCUSS_DAEMON_METRICS_FILE_H
#define PERCUSS_DAEMON_METRICS_FILE_H

#include "daemon/shared.h"

/* Writes what is counted and what is the case to that file: a new one beside it, which then takes
 * its place, so that no reader finds half of one. False with a fault. */
bool metrics_file_write(struct shared *shared, const char *path, struct fault *fault);

#endif
