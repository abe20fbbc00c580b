/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The replies of the last requests of every client, so that a repeated request gets the same reply
 * and is computed once. Also the clients themselves: one that has gone is remembered for a while.
 * Thread-safe. Times are monotonic, s. */
#ifndef PERCUSS_EXCHANGE_REPLY_STORE_H
#define PERCUSS_EXCHANGE_REPLY_STORE_H

#include <stdbool.h>

#include "base/hash.h"
#include "exchange/answer.h"

struct reply_limits {
    size_t per_client; /* replies */
    size_t bytes;      /* of all */
    size_t clients;    /* the ones longest gone are forgotten first */
    double seconds;    /* a client that has gone is remembered */
};

/* A request: its client, topic and number. */
struct request_name {
    const uint8_t *client; /* 16 octets */
    enum exchange exchange;
    uint64_t sequence;
};

enum admission {
    ADMISSION_NEW,      /* to be answered, then given to reply_store_keep or _forget */
    ADMISSION_PENDING,  /* being answered: the reply will come once */
    ADMISSION_REPEATED, /* answered before: here is the reply */
    ADMISSION_CONFLICT, /* the number was used for another question */
    ADMISSION_NO_MEMORY /* to be refused: it could not be told from its repetition */
};

struct reply_store;
struct reply_store *reply_store_create(const struct reply_limits *limits); /* NULL: no memory */
void reply_store_free(struct reply_store *store);

/* Admits a request of this content. *answer is held for the caller if REPEATED, else NULL. */
enum admission reply_store_admit(struct reply_store *store, const struct request_name *name,
                                 struct digest content, double now, struct answer **answer);

/* Keeps the answer to an admitted request (with a reference of its own). */
void reply_store_keep(struct reply_store *store, const struct request_name *name,
                      struct answer *answer);

/* The request stays without a stored reply, as when it was refused for being busy: asked again it
 * is new. */
void reply_store_forget(struct reply_store *store, const struct request_name *name);

/* Whether the client is there to read replies. False: out of memory, and its leaving will not be
 * noticed. */
bool reply_store_set_present(struct reply_store *store, const uint8_t client[16], bool present,
                             double now);

/* Whether the client was there to read replies and is not any more. */
bool reply_store_is_gone(struct reply_store *store, const uint8_t client[16]);

/* Forgets clients gone too long. */
void reply_store_sweep(struct reply_store *store, double now);

/* Numbers of clients and of bytes of replies remembered. */
size_t reply_store_clients(struct reply_store *store);
size_t reply_store_bytes(struct reply_store *store);

#endif
