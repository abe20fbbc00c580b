/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The server that answers, and the others of the domain. */
#ifndef PERCUSS_CLI_OTHERS_H
#define PERCUSS_CLI_OTHERS_H

#include "cli.h"

/* Lets a connected client stay with the server up longest of all that are there by now, and warns
 * on standard error of each other one; does nothing where the user has chosen. EXIT_ANSWERED, or
 * the exit code of a second connection that failed. */
int others_settle(const struct common *common, struct percuss_client *client);

/* After the server has refused a body: names the catalogue of that server, and those of other
 * servers of the domain. */
void others_explain(const struct common *common, struct percuss_client *client);

/* The line of a table that names the server. */
void print_server_line(const uint8_t server[16], const char *catalogue_revision);

#endif
