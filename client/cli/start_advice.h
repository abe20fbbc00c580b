/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The daemon beside this program, built or installed, and how to start it. */
#ifndef PERCUSS_CLI_START_ADVICE_H
#define PERCUSS_CLI_START_ADVICE_H

#include <limits.h>

#include "cli.h"

/* The whole path of its program; false: it is not there. */
bool start_advice_program(char daemon[PATH_MAX]);

/* Its program and its settings, as a user here would write them; false: they are not there. */
bool start_advice_daemon(char daemon[PATH_MAX], char settings[PATH_MAX]);

/* "start one with: ...", for the domain and partition that are asked. */
void start_advice(const struct common *common, char *text, size_t size);

#endif
