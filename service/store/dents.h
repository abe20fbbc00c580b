/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The dents of a specimen as rows of the store. */
#ifndef PERCUSS_STORE_DENTS_H
#define PERCUSS_STORE_DENTS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/fault.h"
#include "base/hash.h"
#include "contact/body_state.h"

struct database;

/* Reads the dents of the specimen with that row, for free(); *state NULL: none. */
enum percuss_status dents_read(struct database *database, int64_t id, struct body_state **state,
                               struct fault *fault);

/* Puts those of a state (NULL: none) in place of what the specimen had; within the caller's
 * transaction. */
bool dents_write(struct database *database, int64_t id, const struct body_state *state);

/* Adds them to a checksum: as they come out of the store, where -0 becomes 0. */
void dents_hash(struct hasher *hasher, const struct body_state *state);

#endif
