/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Who answers, and who else would. */
#ifndef PERCUSS_CLI_OTHERS_H
#define PERCUSS_CLI_OTHERS_H

#include "cli.h"

/* Warns on standard error of each server beside the one that the connected client stays with,
 * unless the user has chosen that one. */
void others_warn(const struct common *common, struct percuss_client *client);

/* The line of a table that says who answered. */
void print_server_line(const uint8_t server[16], const char *catalogue_revision);

#endif
