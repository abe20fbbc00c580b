/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The other servers of the domain, by what they announce. */
#ifndef PERCUSS_ENDPOINT_SERVERS_H
#define PERCUSS_ENDPOINT_SERVERS_H

#include "base/fault.h"
#include "wire.h"

/* A reader of their announcements, which the participant's end closes; 0 with a fault. */
dds_entity_t servers_open(dds_entity_t participant, const char *partition, struct fault *fault);

/* Borrowed during the visit. */
typedef void server_visitor(void *context, const percuss_v1_ServerStatus *status);

/* Shows each of them that is there. One thread at a time. */
void servers_visit(dds_entity_t reader, server_visitor *visitor, void *context);

#endif
