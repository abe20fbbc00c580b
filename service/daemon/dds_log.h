/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What Cyclone DDS has to say, of malformed packets and of strangers above all, goes into the log,
 * which limits their number: anybody who reaches a port can cause them. */
#ifndef PERCUSS_DAEMON_DDS_LOG_H
#define PERCUSS_DAEMON_DDS_LOG_H

/* Before the first entity of DDS. */
void dds_log_begin(void);

#endif
