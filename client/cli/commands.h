/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* All commands: their functions, their options, and a line about each. */
#ifndef PERCUSS_CLI_COMMANDS_H
#define PERCUSS_CLI_COMMANDS_H

#include "cli.h"

struct command {
    const char *name;
    command_function *function;
    const struct argp *argp;
    const char *summary;
};

/* Ends with a command without a name. */
extern const struct command COMMANDS[];

/* NULL: there is none of that name. */
const struct command *commands_find(const char *name);

/* The one that was probably meant: less than half of the name is wrong; NULL: none. */
const struct command *commands_similar(const char *name);

/* A line for each, and `rest` behind them; the caller frees it. NULL: out of memory. */
char *commands_list(const char *rest);

#endif
