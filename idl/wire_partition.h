/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Names of the partitions in which servers and their clients keep to themselves. */
#ifndef PERCUSS_WIRE_PARTITION_H
#define PERCUSS_WIRE_PARTITION_H

#include <stdbool.h>
#include <stdint.h>

enum { WIRE_PARTITION_SIZE = 64, WIRE_REPLIES_SIZE = 35 + WIRE_PARTITION_SIZE };

/* What may be a name: nothing that DDS takes for a pattern. */
#define WIRE_PARTITION_RULE "1 to 63 letters, digits, '.', '_' and '-'"
bool wire_partition_is_good(const char *name);

/* The partition of the replies to a client: "c_" and the 32 hexadecimal digits of its id, and where
 * it asks in a partition (neither NULL nor empty), "." and the name of that. */
void wire_partition_of_replies(const uint8_t client[16], const char *partition,
                               char name[WIRE_REPLIES_SIZE]);

#endif
