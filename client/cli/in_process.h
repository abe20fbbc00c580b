/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The solver in this process, by libpercuss-local, which is loaded when it is first asked for. */
#ifndef PERCUSS_CLI_IN_PROCESS_H
#define PERCUSS_CLI_IN_PROCESS_H

#include "cli.h"

/* A client that answers itself, by the settings and the catalogue that the options name.
 * EXIT_ANSWERED, or complains. */
int in_process_open(const struct common *common, const uint8_t *id, struct percuss_client **client);

#endif
