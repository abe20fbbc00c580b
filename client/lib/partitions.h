/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* In which partitions of the domain servers announce themselves. */
#ifndef PERCUSS_LIB_PARTITIONS_H
#define PERCUSS_LIB_PARTITIONS_H

#include "client.h"

/* Words for where servers are that are not in the client's partition: "; one is in partition gears,
 * one in no partition"; empty: nowhere. */
void partitions_list(const struct percuss_client *client, char *text, size_t size);

#endif
