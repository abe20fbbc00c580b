/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One reply writer per client and kind of reply, in the client's own partition (c_<hex>): an idle
 * client then costs the others nothing. A writer exists as long as the built-in topic of
 * subscriptions shows a reader for it. Thread-safe but for reply_writers_follow. */
#ifndef PERCUSS_ENDPOINT_REPLY_WRITERS_H
#define PERCUSS_ENDPOINT_REPLY_WRITERS_H

#include <stdbool.h>

#include "base/fault.h"
#include "base/hash.h"
#include "endpoint/authorisation.h"
#include "exchange/answer.h"
#include "wire.h"

/* Kinds of samples for clients: the replies of each exchange, and these. */
enum { CHANNEL_PROGRESS = EXCHANGE_COUNT, CHANNEL_SAMPLES, CHANNEL_TRACE, CHANNEL_COUNT };

enum delivery {
    DELIVERY_DONE,
    DELIVERY_NO_READER, /* the client has no reader of such replies */
    DELIVERY_STALLED    /* it does not take its samples; tried again after a second */
};

struct reply_writers;

/* For at most so many clients. NULL with a fault if DDS refuses. */
struct reply_writers *reply_writers_create(dds_entity_t participant, const char *partition,
                                           size_t clients, struct fault *fault);
void reply_writers_free(struct reply_writers *writers);

/* The authorisation of the clients' ids; of the thread of reply_writers_follow. */
struct authorisation *reply_writers_authorisation(const struct reply_writers *writers);

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

/* The clients that read replies, each with a writer for every channel that it reads. Any thread may
 * look a writer up; one thread alone adds and removes readers. */
struct destinations;

/* Makes a writer for a client's channel; 0: there can be none. */
typedef dds_entity_t writer_maker(void *context, const uint8_t client[16], unsigned channel);

/* For at most `most` clients at once. NULL: no memory. */
struct destinations *destinations_create(size_t most, writer_maker *make, void *context);
void destinations_free(struct destinations *destinations);

/* Whether the reader of that key is known. */
bool destinations_know(const struct destinations *destinations, struct digest reader);

struct destination_reader {
    struct digest key;
    struct digest participant; /* of DDS, that it belongs to */
    const uint8_t *client;     /* 16 octets */
    unsigned channel;
};

/* A reader that is not known has come; for the first one of a client and channel a writer is made.
 * False: too many clients, or more than half of the places for those of one participant, or no
 * memory. */
bool destinations_add(struct destinations *destinations, const struct destination_reader *reader);

/* A known reader has gone; `client` becomes its client. Returns the writer that no reader is left
 * for, which the caller deletes; 0: none. */
dds_entity_t destinations_remove(struct destinations *destinations, struct digest reader,
                                 uint8_t client[16]);

/* The writer for a client's channel; 0 with the reason if there is none to be used now. */
dds_entity_t destinations_writer(struct destinations *destinations, const uint8_t client[16],
                                 unsigned channel, enum delivery *reason);

/* The client did not take a sample: for a while no write waits for it and delays the others. */
void destinations_stall(struct destinations *destinations, const uint8_t client[16],
                        unsigned channel);

/* Shows all writers, which stay meanwhile. */
void destinations_visit(struct destinations *destinations,
                        void (*visit)(void *context, dds_entity_t writer), void *context);

/* Number of clients. */
size_t destinations_count(struct destinations *destinations);

#endif
