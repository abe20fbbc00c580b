/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The running service: what the threads share. */
#ifndef PERCUSS_DAEMON_SERVICE_H
#define PERCUSS_DAEMON_SERVICE_H

#include "daemon/ensembles.h"
#include "daemon/neighbours.h"
#include "daemon/queue.h"
#include "daemon/responder.h"
#include "daemon/settings.h"
#include "daemon/snapshot.h"
#include "daemon/specimen_lane.h"
#include "daemon/table_cache.h"
#include "endpoint/endpoint.h"
#include "endpoint/reply_store.h"

/* What is solved within milliseconds does not wait behind what takes seconds. The long lane has one
 * thread of low priority; that of specimens has one so that they see one impact after the other. */
enum lane { LANE_SHORT, LANE_LONG, LANE_SPECIMENS, LANE_COUNT };

struct service {
    const struct settings *settings;
    struct snapshots snapshots;
    struct endpoint *endpoint;
    struct token_store *tokens;
    struct reply_store *replies;
    struct table_cache tables;
    struct specimen_lane *specimens; /* NULL: no store */
    struct queue *lanes[LANE_COUNT];
    struct ensembles ensembles; /* in the long lane */
    struct responder
        *inline_responder; /* of the reading thread, which solves what is cheap itself */
    uint8_t last_client[16];
    double company_until; /* monotonic, s: till then several clients count as asking */
    double started;       /* monotonic, s */
    atomic_bool draining;
    atomic_bool ending;              /* what is being solved is to be given up */
    atomic_ullong answered, refused; /* replies with and without results */
    atomic_ullong undelivered;       /* replies their clients did not take */
    unsigned long long reported;     /* of those, in the log */
    struct neighbours neighbours;    /* the main thread's */
    pthread_t reader;
    bool reader_runs;
    struct worker *workers; /* see workers.c; the last ones work on the other lanes */
    size_t worker_count;    /* that run */
};

/* Loads the catalogue, joins the domain and starts the threads; `settings` stays the caller's and
 * must outlive the service. NULL with a fault. */
struct service *service_create(const struct settings *settings, struct fault *fault);

/* Reads the catalogue again; a bad one is logged and changes nothing. */
void service_reload(struct service *service);

/* Publishes the status and forgets what has expired: to be called about once a second. */
void service_tick(struct service *service);

/* From now on new requests are refused. */
void service_begin_drain(struct service *service);

/* Waits until everything queued is answered and delivered, at most `seconds`. False: not all is. */
bool service_drain(struct service *service, double seconds);

/* Gives up what is being solved, with BUSY, ensembles with what they have, and waits for that as
 * service_drain does. */
bool service_cut_short(struct service *service);

/* Ends the threads and leaves the domain. */
void service_free(struct service *service);

/* The head of the reply to that request, answered from that snapshot, which must stay. */
struct envelope service_envelope(const struct service *service, const struct request_name *name,
                                 const struct snapshot *snapshot);

/* Sends the answer to an admitted request, stores it and counts it; the caller keeps his reference.
 * NULL: there was no memory for one. */
void service_deliver(struct service *service, const struct request_name *name,
                     struct answer *answer);

/* Publishes the status. */
void service_announce(struct service *service);

#endif
