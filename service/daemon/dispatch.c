/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/dispatch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "daemon/client_job.h"
#include "daemon/delivery.h"
#include "daemon/ensemble_job.h"
#include "daemon/log.h"
#include "daemon/pool.h"
#include "daemon/queue.h"
#include "daemon/store_job.h"
#include "exchange/clock.h"
#include "exchange/question.h"
#include "respond/responder.h"

/* Two clients that ask within this time, s, are served side by side by the workers. */
static const double COMPANY_SECONDS = 0.01;

/* Between two lines about clients that get no replies, s. */
static const double REFUSAL_SECONDS = 1.0;

/* A solve that takes longer than this, s, is left to the workers. */
static const double INLINE_SECONDS = 0.005;

struct dispatch {
    struct shared *shared;
    struct responder *responder; /* for cheap requests */
    uint8_t last_client[16];
    double told; /* time of the last line about a client that gets no replies; monotonic, s */
    unsigned long untold; /* such clients since then */
    double company_until; /* monotonic, s: until then several clients count as asking */
};

struct dispatch *dispatch_create(struct shared *shared)
{
    struct dispatch *dispatch = calloc(1, sizeof *dispatch);
    if (!dispatch)
        return NULL;
    dispatch->shared = shared;
    dispatch->responder = shared_responder(shared, LANE_SHORT);
    if (dispatch->responder)
        return dispatch;
    free(dispatch);
    return NULL;
}

void dispatch_free(struct dispatch *dispatch)
{
    if (!dispatch)
        return;
    responder_free(dispatch->responder);
    free(dispatch);
}

/* False: the server ends, and the admitted request was refused. */
static bool is_open(struct shared *shared, const struct request_name *name)
{
    bool draining = atomic_load(&shared->draining);
    if (draining)
        deliver_refusal(shared, name, PERCUSS_BUSY, SHARED_SHUTTING_DOWN);
    return !draining;
}

/* Hands a job (NULL: there was no memory for it) to the workers, or refuses it at once. */
static void enqueue(struct shared *shared, const struct request_name *name, struct client_job *job)
{
    char message[DELIVERY_MESSAGE];
    struct job *displaced = NULL;
    if (!job) {
        deliver_refusal(shared, name, PERCUSS_INTERNAL, "out of memory");
        return;
    }
    bool accepted = queue_put(shared->lanes[job->lane], &job->job, &displaced);
    if (displaced)
        job_refuse(displaced);
    if (accepted)
        return;
    job->job.kind->release(&job->job);
    if (!is_open(shared, name))
        return;
    deliver_refusal(shared, name, PERCUSS_BUSY, delivery_too_many(shared, message));
}

/* Answers a repeated request, and one that reuses the number of another. True: the request is new.
 */
static bool dispatch_admit(struct shared *shared, const struct request_name *name,
                           struct digest content, double now)
{
    struct answer *stored;
    char message[160];
    struct log_request about = {name->client, name->sequence};
    switch (reply_store_admit(shared->replies, name, content, now, &stored)) {
    case ADMISSION_REPEATED:
        log_about(LEVEL_DEBUG, &about, "asked again: gets the stored reply");
        endpoint_reply(shared->endpoint, name->client, stored);
        answer_release(stored);
        return false;
    case ADMISSION_CONFLICT:
        snprintf(message, sizeof message,
                 "sequence: %llu: was used for another request: must be a new number",
                 (unsigned long long)name->sequence);
        deliver_at_once(shared, name, PERCUSS_BAD_REQUEST, message);
        return false;
    case ADMISSION_NO_MEMORY:
        deliver_at_once(shared, name, PERCUSS_INTERNAL, "out of memory");
        return false;
    case ADMISSION_PENDING:
        log_about(LEVEL_DEBUG, &about, "asked again while it is being answered");
        return false;
    case ADMISSION_NEW:
        break;
    }
    return true;
}

/* Whether no other client has asked lately: while the reading thread solves, it reads no requests.
 */
static bool is_sole(struct dispatch *dispatch, const uint8_t client[16], double now)
{
    if (memcmp(dispatch->last_client, client, sizeof dispatch->last_client) != 0)
        dispatch->company_until = now + COMPANY_SECONDS;
    memcpy(dispatch->last_client, client, sizeof dispatch->last_client);
    return now >= dispatch->company_until;
}

/* Whether the reading thread may solve it. */
static bool is_for_here(const struct shared *shared, const percuss_v1_Request *request)
{
    return shared->settings->inline_solves && impact_job_is_cheap(request) &&
           !impact_job_is_durable(shared, request) && !atomic_load(&shared->draining) &&
           queue_length(shared->lanes[LANE_SHORT]) == 0;
}

/* The time that a solve may take of the reading thread. */
struct time_limit {
    double end; /* monotonic, s */
    bool over;
};

static enum percuss_status is_quick(void *context, struct fault *fault)
{
    struct time_limit *limit = context;
    limit->over = clock_now() > limit->end;
    return limit->over ? fault_set(fault, PERCUSS_BUSY, "for the workers") : PERCUSS_OK;
}

/* Whether a body's vibration may have to be computed first, which takes up to some seconds and
 * calls is_quick eight times. */
static bool may_prepare(const struct snapshot *snapshot, const percuss_v1_Request *request)
{
    for (uint32_t i = 0; i < request->bodies._length; i++) {
        const struct body *body = body_set_find(snapshot->set, request->bodies._buffer[i].id);
        if (body && body->kind->box && body_can_vibrate(body))
            return true;
    }
    return false;
}

/* False: the solve took too long and was given up; the request is not answered yet. */
static bool answer_here(struct dispatch *dispatch, const struct request_name *name,
                        const percuss_v1_Request *request, double arrival)
{
    struct shared *shared = dispatch->shared;
    struct time_limit limit = {.end = arrival + INLINE_SECONDS};
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    if (may_prepare(snapshot, request)) {
        snapshots_release(&shared->snapshots, snapshot);
        return false;
    }
    /* the solve ends when the time is over */
    struct question question = {
        .request = request,
        .snapshot = snapshot,
        .envelope = delivery_envelope(shared, name, snapshot),
        .arrival = arrival,
        .still_wanted = is_quick,
        .context = &limit,
    };
    struct answer *answer = responder_answer(dispatch->responder, &question);
    /* a solve that was given up has no answer */
    if (!limit.over)
        deliver(shared, name, answer);
    answer_release(answer);
    responder_settle(dispatch->responder);
    snapshots_release(&shared->snapshots, snapshot);
    return !limit.over;
}

/* Its client does not wait for a request any more. One that is not in a queue was answered before.
 */
static void dispatch_withdraw(struct shared *shared, const struct request_name *name)
{
    struct job *withdrawn = NULL;
    bool found = false;
    for (int lane = 0; !found && lane < LANE_COUNT; lane++)
        found = queue_withdraw(shared->lanes[lane], name, &withdrawn);
    if (withdrawn)
        withdrawn->kind->release(withdrawn);
    if (found)
        log_about(LEVEL_DEBUG, &(struct log_request){name->client, name->sequence}, "%s",
                  SHARED_WITHDRAWN);
}

static void receive_single(void *context, const percuss_v1_Request *request, bool alone)
{
    struct dispatch *dispatch = context;
    struct shared *shared = dispatch->shared;
    double arrival = clock_now();
    struct request_name name = {request->client, EXCHANGE_SINGLE, request->sequence};
    if (request->cancel) {
        dispatch_withdraw(shared, &name);
        return;
    }
    /* a ping */
    if (request->sequence == 0) {
        deliver_at_once(shared, &name, PERCUSS_OK, "");
        return;
    }
    /* a repetition */
    if (!dispatch_admit(shared, &name, question_digest_single(request), arrival))
        return;
    /* a solve that is given up here is begun anew by a worker, with the same bits */
    bool sole = is_sole(dispatch, request->client, arrival);
    if (alone && sole && is_for_here(shared, request) &&
        answer_here(dispatch, &name, request, arrival))
        return;
    if (is_open(shared, &name))
        enqueue(shared, &name, impact_job_create(shared, &name, request, 1, arrival));
}

static void receive_batch(void *context, const percuss_v1_BatchRequest *batch)
{
    struct shared *shared = ((struct dispatch *)context)->shared;
    double arrival = clock_now();
    struct request_name name = {batch->client, EXCHANGE_BATCH, batch->sequence};
    const char *problem = batch->sequence == 0           ? "sequence: 0: must be > 0 for a batch"
                          : batch->requests._length == 0 ? "requests: none given: must be 1 to 256"
                                                         : NULL;
    if (batch->cancel)
        dispatch_withdraw(shared, &name);
    else if (problem)
        deliver_at_once(shared, &name, PERCUSS_BAD_REQUEST, problem);
    else if (dispatch_admit(shared, &name, question_digest_batch(batch), arrival) &&
             is_open(shared, &name))
        enqueue(shared, &name,
                impact_job_create(shared, &name, batch->requests._buffer, batch->requests._length,
                                  arrival));
}

static void receive_ensemble(void *context, const percuss_v1_EnsembleRequest *request)
{
    struct shared *shared = ((struct dispatch *)context)->shared;
    double arrival = clock_now();
    struct request_name name = {request->client, EXCHANGE_ENSEMBLE, request->sequence};
    if (request->cancel)
        ensembles_cancel(&shared->ensembles, request->client, request->sequence);
    else if (request->sequence == 0)
        deliver_at_once(shared, &name, PERCUSS_BAD_REQUEST,
                        "sequence: 0: must be > 0 for an ensemble");
    else if (dispatch_admit(shared, &name, question_digest_ensemble(request), arrival) &&
             is_open(shared, &name))
        enqueue(shared, &name, ensemble_job_create(shared, &name, request, arrival));
}

/* Queued among the requests that name specimens; a client that sees no effect asks again. */
static void receive_clear(void *context, const char *specimen)
{
    struct shared *shared = ((struct dispatch *)context)->shared;
    if (!specimen[0] || atomic_load(&shared->draining))
        return;
    struct job *job = clear_job_create(shared, specimen);
    struct job *displaced = NULL;
    bool accepted = job && queue_put(shared->lanes[LANE_SPECIMENS], job, &displaced);
    if (displaced)
        job_refuse(displaced);
    if (accepted)
        return;
    log_line(LEVEL_WARNING, "specimen %s: not cleared: %s", specimen,
             job ? "too many requests are waiting" : "out of memory");
    if (job)
        job->kind->release(job);
}

/* Logs clients that get no replies: a line a second at most, with their number since the last. */
static void note_refused(struct dispatch *dispatch, const char *client)
{
    double now = clock_now();
    dispatch->untold++;
    if (now < dispatch->told + REFUSAL_SECONDS)
        return;
    log_line(LEVEL_WARNING,
             "client %s: gets no replies (%lu such since the last line): %u clients are there of "
             "limits.clients %u, half of them at most by one participant; or no memory",
             client, dispatch->untold, (unsigned)endpoint_clients(dispatch->shared->endpoint),
             dispatch->shared->settings->limit_clients);
    dispatch->told = now;
    dispatch->untold = 0;
}

static void note_presence(void *context, const uint8_t client[16], enum presence presence)
{
    struct shared *shared = ((struct dispatch *)context)->shared;
    char name[WIRE_REPLIES_SIZE];
    wire_partition_of_replies(client, NULL, name);
    if (presence == READER_REFUSED) {
        note_refused(context, name);
        return;
    }
    bool present = presence == READER_COME;
    log_line(LEVEL_DEBUG, "client %s: a reader of replies has %s", name, present ? "come" : "gone");
    reply_store_set_present(shared->replies, client, present, clock_now());
}

static void note_alive(void *context)
{
    (void)context;
    heartbeat_beat();
}

struct endpoint_handler dispatch_handler(struct dispatch *dispatch)
{
    return (struct endpoint_handler){
        .context = dispatch,
        .single = receive_single,
        .batch = receive_batch,
        .ensemble = receive_ensemble,
        .clear = receive_clear,
        .presence = note_presence,
        .alive = note_alive,
    };
}
