/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Several daemons with one task, of which one answers and the others wait for its place. The one
 * that answers has the lock of a file: when its process ends, in any way, the system gives the lock
 * to the next one. The file has the server id under which they answer, one after the other. */
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

/* Whether the file of that name can be the place, or can be made. PERCUSS_BAD_REQUEST with "FILE:
 * ...".
 */
enum percuss_status standby_check(const char *path, struct fault *fault);

/* Whether the place is still this process's, and the file the one of that name: a network's file
 * system takes the lock from a machine that was cut off, and a user may delete the file. */
bool standby_is_held(const char *path);

/* The end of a standby's wait. */
enum standby_end { STANDBY_TAKEN, STANDBY_STOPPED, STANDBY_FAILED };

/* Waits for the place that the settings name: until it is this process's, a signal asks for the
 * end, or a fault. The manager and the log get messages. While it waits, SIGHUP makes it check the
 * catalogue. */
enum standby_end standby_wait(const struct settings *settings, const sigset_t *signals,
                              const struct notifier *notifier, uint8_t server[16],
                              struct fault *fault);

#endif
