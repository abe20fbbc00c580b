/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Other DDS domains of this host, for a question in the wrong one. */
#ifndef PERCUSS_CLI_DOMAINS_H
#define PERCUSS_CLI_DOMAINS_H

#include "cli.h"

enum { DOMAINS_MOST = 12 };

/* The domains but `common`'s in which a server of its partition announces itself, their number.
 * Takes half a second at most; no more than DOMAINS_MOST are asked. */
size_t domains_with_server(const struct common *common, unsigned domains[DOMAINS_MOST]);

#endif
