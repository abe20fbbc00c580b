/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The topic of specimens: the server announces their dents, clients ask to clear them. Clients
 * write volatile samples, which the readers of announcements do not get. */
#ifndef PERCUSS_ENDPOINT_DENTS_TOPIC_H
#define PERCUSS_ENDPOINT_DENTS_TOPIC_H

#include <stdbool.h>

#include "base/fault.h"
#include "contact/body_state.h"
#include "wire.h"

struct dents_topic {
    dds_entity_t reader, writer; /* 0: not open */
    uint8_t server[16];
};

/* Opens it for that server. The participant's end closes it. False with a fault. */
bool dents_topic_open(struct dents_topic *topic, dds_entity_t participant, const char *partition,
                      const uint8_t server[16], struct fault *fault);

/* What is told of a specimen. */
struct dents_notice {
    const char *specimen, *body;
    uint64_t impacts;
    const struct body_state *state; /* NULL: no dents */
};

/* Any thread. */
void dents_topic_announce(const struct dents_topic *topic, const struct dents_notice *notice);
void dents_topic_withdraw(const struct dents_topic *topic, const char *specimen);

/* Shows the specimens of this server that clients want cleared. */
void dents_topic_take(const struct dents_topic *topic,
                      void (*clear)(void *context, const char *specimen), void *context);

#endif
