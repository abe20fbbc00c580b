/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Other DDS domains of this host, for a question in the wrong one. */
#ifndef PERCUSS_CLI_DOMAINS_H
#define PERCUSS_CLI_DOMAINS_H

#include <stdio.h>

#include "cli.h"

enum { DOMAINS_MOST = 12, DOMAINS_COUNT = 231 };

/* Marks the domains with a participant on this host: `table`, in the form of /proc/net/udp, lists
 * their UDP ports as bound. */
void domains_by_ports(FILE *table, bool taken[DOMAINS_COUNT]);

/* The domains but `common`'s in which a server of its partition announces itself, their number.
 * Takes half a second at most; no more than DOMAINS_MOST are asked. */
size_t domains_with_server(const struct common *common, unsigned domains[DOMAINS_MOST]);

#endif
