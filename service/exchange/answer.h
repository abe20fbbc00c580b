/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A finished reply, ready to be written any number of times. Immutable once it is shared; counted
 * references, since it is written, stored and written again from different threads. */
#ifndef PERCUSS_EXCHANGE_ANSWER_H
#define PERCUSS_EXCHANGE_ANSWER_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "percuss_wire.h"

/* Kinds of requests, each with a topic of its own and one for its replies. */
enum exchange { EXCHANGE_SINGLE, EXCHANGE_BATCH, EXCHANGE_ENSEMBLE, EXCHANGE_COUNT };

/* The head of every reply. */
struct envelope {
    const uint8_t *client, *server; /* 16 octets each */
    uint64_t sequence;
    const char *revision; /* of the catalogue */
    const char *version;  /* of the service */
};

struct answer {
    atomic_uint holders;
    enum exchange exchange;
    bool passing;            /* BUSY and the like: the same request may get another one later */
    size_t bytes;            /* of memory, with all that it keeps alive */
    percuss_v1_Reply *reply; /* EXCHANGE_SINGLE; EXCHANGE_BATCH: all, side by side */
    percuss_v1_Reply
        *decoded; /* that reply if it was made of bytes, and the function that frees it: */
    void (*free_decoded)(percuss_v1_Reply *decoded);
    percuss_v1_BatchReply *parts;     /* EXCHANGE_BATCH */
    percuss_v1_EnsembleReply *report; /* EXCHANGE_ENSEMBLE */
    struct answer **members;          /* of a batch: it points into them */
    percuss_v1_Trace *traces;         /* EXCHANGE_SINGLE: written before the reply */
    size_t part_count, member_count, trace_count;
    size_t taken, room; /* of the block behind this structure */
};

/* An answer with zeroed room for `room` bytes, held once; NULL: out of memory. */
struct answer *answer_create(enum exchange exchange, size_t room);
struct answer *answer_hold(struct answer *answer);
void answer_release(struct answer *answer); /* NULL is allowed */

/* The room that `count` items of `size` bytes need. */
size_t answer_room(size_t count, size_t size);

/* The next piece of the answer's own memory, within the room of answer_create. */
void *answer_take(struct answer *answer, size_t count, size_t size);

#endif
