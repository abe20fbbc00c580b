/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A client's id belongs to the first DDS participant with a reader of its replies, for as long as
 * it has one: requests that bear the id and come from another participant are not the client's. One
 * thread only. */
#ifndef PERCUSS_ENDPOINT_AUTHORISATION_H
#define PERCUSS_ENDPOINT_AUTHORISATION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/hash.h"
#include "wire.h"

struct authorisation;
struct authorisation *authorisation_create(void); /* NULL: no memory */
void authorisation_free(struct authorisation *authorisation);

/* The participant of a reader or writer, from its GUID. */
struct digest authorisation_participant(struct digest guid);

/* A reader of the client's replies has come, or gone, which must have come before. False: no
 * memory. */
bool authorisation_add(struct authorisation *authorisation, const uint8_t client[16],
                       struct digest participant);
void authorisation_remove(struct authorisation *authorisation, const uint8_t client[16],
                          struct digest participant);

/* Whether the participant may use the id: it owns the id, or no participant does. */
bool authorisation_allow(const struct authorisation *authorisation, const uint8_t client[16],
                         struct digest participant);

/* The same for the participant of a writer that `reader` has a sample of. A writer that has gone
 * and is not remembered is a stranger. */
bool authorisation_allow_writer(struct authorisation *authorisation, const uint8_t client[16],
                                dds_entity_t reader, dds_instance_handle_t writer);

#endif
