/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The readers of replies that come and go in the domain, as DDS's built-in topic shows them. */
#ifndef PERCUSS_ENDPOINT_SUBSCRIPTIONS_H
#define PERCUSS_ENDPOINT_SUBSCRIPTIONS_H

#include <stdbool.h>

#include "base/fault.h"
#include "base/hash.h"
#include "wire.h"

/* A reader that has come or gone; of one that has gone only the key is told. */
struct subscription {
    struct digest key;
    struct digest participant; /* of DDS, which it belongs to */
    bool alive;
    bool is_client; /* it reads in a client's partition: that client's */
    uint8_t client[16];
    const char *topic; /* borrowed */
};

/* The reader of that topic, to wait on, which the participant's end closes; 0 with a fault. */
dds_entity_t subscriptions_open(dds_entity_t participant, struct fault *fault);

/* Shows what has changed since the last call; clients are those who ask in `partition`. */
void subscriptions_take(dds_entity_t reader, const char *partition,
                        void (*visit)(void *context, const struct subscription *subscription),
                        void *context);

#endif
