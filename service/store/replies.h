/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The replies that are kept with the dents they speak of: the last ones, and of each client the
 * highest number among those that are no longer kept, its mark. */
#ifndef PERCUSS_STORE_REPLIES_H
#define PERCUSS_STORE_REPLIES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"

struct audit;
struct database;

/* The reply to a request. */
struct stored_reply {
    uint8_t client[16];
    uint64_t sequence;
    uint64_t content[2]; /* hash of the request */
    size_t size;
    void *bytes;  /* in the form the caller chose */
    bool damaged; /* found, but not what was kept */
};

/* Keeps a reply, with a checksum over all that its row says; within the caller's transaction. */
bool replies_keep(struct database *database, const struct stored_reply *reply);

/* Drops the reply that was stored first and sets the mark of its client; likewise. */
bool replies_drop_oldest(struct database *database);

/* The reply kept under reply->client and ->sequence: fills in the rest, and the caller free()s
 * ->bytes; NULL: there was no such request. PERCUSS_BAD_REQUEST: replies of that client with
 * numbers as high are no longer kept, so that nobody knows whether there was one. PERCUSS_INTERNAL:
 * with ->damaged what the file holds is not what was kept: its size or checksum differs; without,
 * it cannot be read now, or the mark of its client is damaged, and nobody knows whether there was
 * one. */
enum percuss_status replies_find(struct database *database, struct stored_reply *reply,
                                 struct fault *fault);

/* Looks at all replies and marks and complains of those that are not what was kept. False: they
 * cannot be read. */
bool replies_audit(struct database *database, struct audit *audit);

/* Gives a checksum to replies and marks that have none: those of older files. */
bool replies_fill(struct database *database);

#endif
