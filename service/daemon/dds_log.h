/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What Cyclone DDS has to say, of malformed packets and of strangers above all, goes into the log:
 * some lines of it, and of the rest how many. */
#ifndef PERCUSS_DAEMON_DDS_LOG_H
#define PERCUSS_DAEMON_DDS_LOG_H

/* Before the first entity of DDS. */
void dds_log_begin(void);

/* To be called once a second: every ten seconds it logs how many lines were left out, and lets some
 * pass again. */
void dds_log_report(void);

#endif
