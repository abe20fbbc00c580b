/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_LIB_CONNECT_H
#define PERCUSS_LIB_CONNECT_H

#include "client.h"

/* Waits until the server that the client stays with reads from `writer` and writes to `reader`.
 * TIMEOUT at the deadline, NO_SERVER when it has gone. */
enum percuss_result connect_match(struct percuss_client *client, dds_entity_t writer,
                                  dds_entity_t reader, double deadline);

#endif
