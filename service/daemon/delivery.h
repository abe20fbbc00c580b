/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stores, counts and sends replies. Any thread. */
#ifndef PERCUSS_DAEMON_DELIVERY_H
#define PERCUSS_DAEMON_DELIVERY_H

#include "daemon/shared.h"

/* The head of the reply to that request, answered from that snapshot, which must stay. */
struct envelope delivery_envelope(const struct shared *shared, const struct request_name *name,
                                  const struct snapshot *snapshot);

/* Sends the answer to an admitted request, stores it and counts it; the caller keeps its reference.
 * NULL: there was no memory for one, and the request is refused for that. */
void deliver(struct shared *shared, const struct request_name *name, struct answer *answer);

/* The message where too many jobs wait, written into `message`, which is returned. */
enum { DELIVERY_MESSAGE = 128 };
const char *delivery_too_many(const struct shared *shared, char message[DELIVERY_MESSAGE]);

/* Refuses an admitted request for a reason that passes: when it is asked again, it is new. */
void deliver_refusal(struct shared *shared, const struct request_name *name,
                     enum percuss_status status, const char *message);

/* Sends a reply that is not stored: a refusal, after which the number may be used again, or, with
 * PERCUSS_OK, the answer to a ping. */
void deliver_at_once(struct shared *shared, const struct request_name *name,
                     enum percuss_status status, const char *message);

#endif
