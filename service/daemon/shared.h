/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the threads of the daemon share: the reading thread, the workers, and the main thread, which
 * makes it before the others start and takes it apart after they have ended. */
#ifndef PERCUSS_DAEMON_SHARED_H
#define PERCUSS_DAEMON_SHARED_H

#include <limits.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <time.h>

#include "daemon/activity.h"
#include "daemon/ensembles.h"
#include "daemon/metrics.h"
#include "endpoint/endpoint.h"
#include "exchange/reply_store.h"
#include "exchange/token_store.h"
#include "respond/settings.h"
#include "respond/snapshot.h"
#include "respond/table_cache.h"

struct queue;
struct specimen_lane;

/* What is solved within milliseconds does not wait behind what takes seconds, nor that behind what
 * takes minutes. Only the short lane and that of specimens have workers of full priority; the
 * latter has one so that specimens see one impact after the other, that of tables so that none is
 * computed twice. A lane passes on to those below it only. */
enum lane { LANE_SHORT, LANE_LONG, LANE_TABLES, LANE_ENSEMBLES, LANE_SPECIMENS, LANE_COUNT };

struct shared {
    /* never changed while the threads run */
    const struct settings *settings;
    double started;           /* monotonic, s */
    char catalogue[PATH_MAX]; /* whole path of its file, for others */
    time_t identity_end; /* of a secured daemon's certificates and permissions; 0: not secured */

    /* for any thread: each has a lock of its own */
    struct snapshots snapshots;
    struct token_store *tokens;
    struct reply_store *replies;
    struct table_cache tables;
    struct ensembles ensembles; /* in their lane */
    struct activity activity;   /* of what takes minutes */
    struct activity reduction;  /* of percuss-reduce, which the main thread runs */
    struct metrics metrics;
    struct queue *lanes[LANE_COUNT];

    /* for the threads that their headers name */
    struct endpoint *endpoint;
    struct specimen_lane *specimens; /* NULL: no store */

    /* the main thread sets them, any thread looks */
    atomic_bool draining; /* new requests are refused */
    atomic_uint others;   /* servers beside this one */

    /* any thread counts, the main thread looks */
    atomic_ullong answered, refused; /* replies with and without results */
    atomic_ullong undelivered;       /* replies their clients did not take */
};

/* What clients are told by more than one module. */
#define SHARED_SHUTTING_DOWN "the server is shutting down: ask another one"
#define SHARED_WITHDRAWN     "cancelled by its client"
#define SHARED_CLIENT_GONE   "the client had gone: ask again"

/* Loads the catalogue and the tables into what is zeroed; the endpoint and the specimens are the
 * caller's to open and to close. `settings` is borrowed. False with a fault; release it all the
 * same. */
bool shared_create(struct shared *shared, const struct settings *settings, struct fault *fault);
void shared_release(struct shared *shared);

#endif
