/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A topic's type inside DDS, for tests that hand it bytes; everybody else uses wire_topic_create.
 */
#ifndef PERCUSS_WIRE_TOPIC_H
#define PERCUSS_WIRE_TOPIC_H

#include <dds/dds.h>

struct ddsi_sertype;

/* As wire_topic_create; `type` (may be NULL) lives as long as the topic. */
dds_entity_t wire_topic_create_typed(dds_entity_t participant,
                                     const dds_topic_descriptor_t *descriptor, const char *name,
                                     const struct ddsi_sertype **type);

#endif
