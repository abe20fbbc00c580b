/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Data that the threads of the daemon share: the reading thread, the workers, and the main thread,
 * which creates them before the others start and releases them after they have ended. */
#ifndef PERCUSS_DAEMON_SHARED_H
#define PERCUSS_DAEMON_SHARED_H

#include <limits.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/queue.h>
#include <time.h>

#include "daemon/metrics.h"
#include "endpoint/endpoint.h"
#include "exchange/reply_store.h"
#include "exchange/token_store.h"
#include "respond/responder.h"
#include "respond/settings.h"
#include "respond/snapshot.h"
#include "respond/table_cache.h"

struct queue;
struct specimen_lane;

/* Work that takes long, for the status. Any thread. */
struct activity {
    pthread_mutex_t lock; /* of all below */
    const void *owner;    /* that set it; NULL: none */
    char text[128];       /* empty: no work */
    double progress;      /* 0 .. 1; NAN: no work */
    double begun;         /* monotonic, s; NAN: no work */
};

void activity_create(struct activity *activity);
void activity_release(struct activity *activity);

/* The work in words, and its progress. `owner` tells it from other work that runs at the same time:
 * it is taken unless another owner's stands there, until that one clears it. */
void activity_set(struct activity *activity, const void *owner, double progress, const char *format,
                  ...) __attribute__((format(printf, 4, 5)));

/* The work of `owner` has ended. */
void activity_clear(struct activity *activity, const void *owner);

/* Copies it; the text is cut to fit. */
void activity_read(struct activity *activity, char *text, size_t size, double *progress);

/* The time at which the work began, monotonic, s; NAN: there is none. */
double activity_begun(struct activity *activity);

/* The ensembles that wait or run: their clients cancel them, or wait for their turn. Any thread. */
struct ensemble_entry {
    LIST_ENTRY(ensemble_entry) all; /* under the lock */
    const uint8_t *client;          /* 16 octets */
    uint64_t sequence;
    uint64_t samples;      /* that are asked for */
    atomic_bool running;   /* it does not wait for its turn any more */
    atomic_bool cancelled; /* no more samples are wanted */
};

struct ensembles {
    pthread_mutex_t lock;
    LIST_HEAD(ensemble_list, ensemble_entry) all;
};

void ensembles_create(struct ensembles *ensembles);
void ensembles_release(struct ensembles *ensembles);

/* The entry, filled by the caller, must stay where it is until it leaves. */
void ensembles_enter(struct ensembles *ensembles, struct ensemble_entry *entry);
void ensembles_leave(struct ensembles *ensembles, struct ensemble_entry *entry);

/* The client does not want it any more; no effect if there is no such ensemble. */
void ensembles_cancel(struct ensembles *ensembles, const uint8_t client[16], uint64_t sequence);

/* Shows each that waits for its turn. */
void ensembles_visit_waiting(struct ensembles *ensembles,
                             void (*visit)(void *context, const struct ensemble_entry *waiting),
                             void *context);

/* A solve of milliseconds does not wait behind one of seconds, nor that behind one of minutes. Only
 * the short lane and that of specimens have workers of full priority; the latter has one worker so
 * that specimens see one impact after the other, that of tables so that no table is computed twice.
 * A lane demotes items to those below it only. */
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
    struct solve_account prepared; /* bodies of the threads that solve */
    struct reply_store *replies;
    struct table_cache tables;
    struct ensembles ensembles; /* in their lane */
    struct activity activity;   /* of solves that take minutes */
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

/* Messages to clients that more than one module sends. */
#define SHARED_SHUTTING_DOWN "the server is shutting down: ask another one"
#define SHARED_WITHDRAWN     "cancelled by its client"
#define SHARED_CLIENT_GONE   "the client had gone: ask again"

/* Loads the catalogue and the tables into zeroed memory; the endpoint and the specimens are the
 * caller's to open and to close. `settings` is borrowed. False with a fault; release it all the
 * same. */
bool shared_create(struct shared *shared, const struct settings *settings, struct fault *fault);
void shared_release(struct shared *shared);

/* A responder for a lane; only in that of tables, missing ones are computed when a request insists
 * on them, which takes seconds to minutes. NULL: out of memory. */
struct responder *shared_responder(struct shared *shared, enum lane lane);

/* For struct table_wait with `shared` as the context: tells the status the progress of a table, and
 * whether a client waits for it. */
enum percuss_status shared_table_goes_on(void *shared, const struct table_maker *maker, double done,
                                         struct fault *fault);
void shared_table_ended(void *shared, const struct table_maker *maker);

#endif
