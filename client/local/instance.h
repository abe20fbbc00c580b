/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A client that answers itself: all that it has. */
#ifndef PERCUSS_LOCAL_INSTANCE_H
#define PERCUSS_LOCAL_INSTANCE_H

#include <percuss/local.h>
#include <pthread.h>
#include <stdatomic.h>

#include "exchange/token_store.h"
#include "operations.h"
#include "respond/responder.h"
#include "respond/settings.h"
#include "respond/snapshot.h"
#include "respond/table_cache.h"
#include "store/specimens.h"
#include "watching.h"

struct desk;
struct outstanding;

struct percuss_client {
    const struct client_operations *operations; /* first, see operations.h */

    /* constant once made */
    uint8_t id[16];
    double started;   /* monotonic, s */
    unsigned threads; /* of an ensemble */
    struct settings settings;
    struct snapshot *snapshot;

    /* for any thread: each has a lock of its own */
    struct snapshots snapshots;
    struct table_cache tables;
    struct token_store *tokens;
    atomic_ullong answered, refused; /* replies with and without results */

    /* one impact on specimens after the other */
    pthread_mutex_t specimens_lock;
    struct specimen_store *specimens; /* NULL: none are kept */

    pthread_mutex_t lock; /* guards everything below */
    uint64_t next_sequence;
    struct watching watching;
    struct desk *idle;                /* desks not in use */
    struct outstanding *first, *last; /* questions of percuss_submit, in their order */
    size_t outstanding_count;
};

/* Takes `count` consecutive sequences, beginning with `wanted` if that is not 0. */
uint64_t instance_draw_sequences(struct percuss_client *client, uint64_t wanted, size_t count);

/* Forgets all questions of percuss_submit (outstanding.c). */
void outstanding_clear(struct percuss_client *client);

/* 16 octets that all clients of this library answer under. */
extern const uint8_t INSTANCE_SERVER[16];

#endif
