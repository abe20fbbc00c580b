/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One reply writer per client and kind of reply, in the client's own partition (c_<hex>): an idle
 * client then costs the others nothing. A writer exists as long as the built-in topic of
 * subscriptions shows a reader for it. Thread-safe but for reply_writers_follow. */
#ifndef PERCUSS_ENDPOINT_REPLY_WRITERS_H
#define PERCUSS_ENDPOINT_REPLY_WRITERS_H

#include <stdbool.h>

#include "base/fault.h"
#include "endpoint/destinations.h"
#include "endpoint/owners.h"

struct reply_writers;

/* For at most so many clients. NULL with a fault if DDS refuses. */
struct reply_writers *reply_writers_create(dds_entity_t participant, const char *partition,
                                           size_t clients, struct fault *fault);
void reply_writers_free(struct reply_writers *writers);

/* The owners of the clients' ids; of the thread of reply_writers_follow. */
struct owners *reply_writers_owners(const struct reply_writers *writers);

/* The reader of subscriptions, to wait on. */
dds_entity_t reply_writers_source(const struct reply_writers *writers);

/* Receives the change of a reader of this client's replies. */
enum presence {
    READER_COME,
    READER_GONE,
    READER_REFUSED /* it gets no replies: too many clients, or no memory */
};
typedef void presence_function(void *context, const uint8_t client[16], enum presence presence);

/* Creates and deletes writers for the readers that came and went since the last call. One thread
 * only. */
void reply_writers_follow(struct reply_writers *writers, presence_function *presence,
                          void *context);

/* Writes the answer, all parts of it, to its client. */
enum delivery reply_writers_write(struct reply_writers *writers, const uint8_t client[16],
                                  const struct answer *answer);

/* Writes a sample of a channel that is no exchange, EnsembleProgress or EnsembleSamples.
 * `patience`: how many times 0.1 s it may take; 0: at most once. */
enum delivery reply_writers_publish(struct reply_writers *writers, const uint8_t client[16],
                                    unsigned channel, const void *sample, unsigned patience);

/* Waits until the clients have everything that was written, at most `seconds`. */
void reply_writers_flush(struct reply_writers *writers, double seconds);

/* Number of clients that read replies. */
size_t reply_writers_count(struct reply_writers *writers);

#endif
