/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The files of a daemon of this machine, as its own check of them sees them: percussd
 * --check-config. */
#ifndef PERCUSS_DOCTOR_STATE_H
#define PERCUSS_DOCTOR_STATE_H

#include "finding.h"
#include "wire_daemons.h"

/* Those of a running one, with the arguments and in the folder that it was started with, if what it
 * runs is `program`, a whole path. What only its user and root can read is left to them, which is
 * found. */
void state_look_at_running(const struct wire_daemon *daemon, const char *program,
                           struct findings *findings);

/* Those that a daemon would have that is started by `program` with `settings` in that domain. */
void state_look_at_start(const char *program, const char *settings, uint32_t domain,
                         struct findings *findings);

#endif
