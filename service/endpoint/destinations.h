/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The clients that read replies, each with a writer for every channel that it reads. Any thread may
 * ask; one thread alone adds and removes readers. */
#ifndef PERCUSS_ENDPOINT_DESTINATIONS_H
#define PERCUSS_ENDPOINT_DESTINATIONS_H

#include <stdbool.h>

#include "base/hash.h"
#include "exchange/answer.h"
#include "wire.h"

/* Kinds of samples for clients: the replies of each exchange, and these. */
enum { CHANNEL_PROGRESS = EXCHANGE_COUNT, CHANNEL_SAMPLES, CHANNEL_TRACE, CHANNEL_COUNT };

enum delivery {
    DELIVERY_DONE,
    DELIVERY_NO_READER, /* the client has no reader of such replies */
    DELIVERY_STALLED    /* it does not take its samples; tried again after a second */
};

/* Makes a writer for a client's channel; 0: there can be none. */
typedef dds_entity_t writer_maker(void *context, const uint8_t client[16], unsigned channel);

struct destinations;
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
