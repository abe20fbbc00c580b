/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_LIB_CONNECT_H
#define PERCUSS_LIB_CONNECT_H

#include "client.h"

/* Waits until one server reads from `writer` and writes to `reader`. NO_SERVER at the deadline;
 * INCOMPATIBLE after 2 s or at the deadline if a quality of service does not fit. */
enum percuss_result connect_match(struct percuss_client *client, dds_entity_t writer,
                                  dds_entity_t reader, double deadline);

#endif
