/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Shared memory in a configuration of Cyclone DDS. Without the daemon that hands it out (iox-roudi)
 * the transport waits for it for a minute, hears no signal meanwhile, and ends the process. */
#ifndef PERCUSS_WIRE_SHARED_H
#define PERCUSS_WIRE_SHARED_H

#include <stdbool.h>

/* Whether a configuration, with commas between files and XML as in CYCLONEDDS_URI, has SharedMemory
 * enabled, for whichever domain. */
bool wire_shared_is_asked(const char *configuration);

/* Whether the daemon is there that hands out shared memory. */
bool wire_shared_is_there(void);

#endif
