/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What may follow on a command line that is being typed, for the shells. */
#ifndef PERCUSS_CLI_COMPLETE_H
#define PERCUSS_CLI_COMPLETE_H

#include "cli.h"

/* argv[1] and on: the words behind the program's name, the last one unfinished, maybe empty. Prints
 * a line for each way to go on, what it is behind a tab; or ":files" where a file is to be named.
 */
command_function command_complete;

#endif
