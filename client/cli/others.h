/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Who answers, and who else would. */
#ifndef PERCUSS_CLI_OTHERS_H
#define PERCUSS_CLI_OTHERS_H

#include "cli.h"

/* Lets a connected client stay with the server up longest of all that are there by now, and warns
 * on standard error of each other one; does nothing where the user has chosen. EXIT_ANSWERED, or
 * the exit code of a second connection that failed. */
int others_settle(const struct common *common, struct percuss_client *client);

/* After the server has refused a body: complains whose catalogue that was, and of those that other
 * servers of the domain have. */
void others_explain(const struct common *common, struct percuss_client *client);

/* The line of a table that says who answered. */
void print_server_line(const uint8_t server[16], const char *catalogue_revision);

#endif
