/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Several daemons with one task, of which one answers and the others wait for its place. Whose turn
 * it is, is whose process has the lock of a file: when it ends, however it ends, the system gives
 * the lock to the next one. The file says under which server id they answer, one after the other.
 */
#ifndef PERCUSS_DAEMON_STANDBY_H
#define PERCUSS_DAEMON_STANDBY_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/fault.h"
#include "daemon/notify.h"
#include "respond/settings.h"

/* Tries to take the place, for as long as this process lives, and reads or draws the server id.
 * PERCUSS_BUSY: another process has it. PERCUSS_BAD_REQUEST with "FILE: ...": the file cannot be
 * used. The same file must not be opened elsewhere in the process: closing it there would give the
 * lock away. */
enum percuss_status standby_take(const char *path, uint8_t server[16], struct fault *fault);

/* Whether the place is still this process's, and the file the one of that name: a network's file
 * system takes the lock from a machine that was cut off, and somebody may delete the file. */
bool standby_is_held(const char *path);

/* What a standby's wait comes to. */
enum standby_end { STANDBY_TAKEN, STANDBY_STOPPED, STANDBY_FAILED };

/* Waits for the place that the settings name: until it is this process's, a signal asks for the
 * end, or a fault. The manager and the log are told. While it waits, SIGHUP has it look whether the
 * catalogue is good. */
enum standby_end standby_wait(const struct settings *settings, const sigset_t *signals,
                              const struct notifier *notifier, uint8_t server[16],
                              struct fault *fault);

#endif
