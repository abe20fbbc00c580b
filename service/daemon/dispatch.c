/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/dispatch.h"

#include <stdio.h>
#include <string.h>

#include "daemon/log.h"
#include "endpoint/clock.h"
#include "endpoint/encode.h"
#include "endpoint/question.h"

/* Finer solutions than these take tens of milliseconds, which the reading thread must not; or
 * seconds, for which there is the long lane. */
static const double cheap_tolerance = 1e-4, short_tolerance = 1e-9;

/* Two clients that ask within this time, s, are served side by side by the workers. */
static const double company_seconds = 0.01;

/* Warm solves of what is_cheap says take some 0.02 to 0.5 ms; what takes longer than this, s, is
 * not cheap whatever it looks like. */
static const double inline_seconds = 0.005;

static struct answer *refusal(const struct envelope *envelope, enum exchange exchange,
                              enum percuss_status status, const char *message)
{
    if (exchange == EXCHANGE_BATCH)
        return encode_batch_refusal(envelope, status, message);
    if (exchange == EXCHANGE_ENSEMBLE)
        return encode_ensemble_refusal(envelope, status, message);
    return encode_refusal(envelope, status, message);
}

/* Sends a reply that is not stored: a refusal, after which the number may be used again, or the
 * answer to a ping. */
static void reply_at_once(struct service *service, const struct request_name *name,
                          enum percuss_status status, const char *message)
{
    struct snapshot *snapshot = snapshots_hold(&service->snapshots);
    struct envelope envelope = service_envelope(service, name, snapshot);
    struct answer *answer = refusal(&envelope, name->exchange, status, message);
    snapshots_release(&service->snapshots, snapshot);
    if (!answer)
        return;
    endpoint_reply(service->endpoint, name->client, answer);
    answer_release(answer);
    if (status != PERCUSS_OK)
        atomic_fetch_add(&service->refused, 1);
}

/* A refusal of an admitted request for how things stand. */
static void turn_away(struct service *service, const struct request_name *name)
{
    char message[128];
    reply_store_forget(service->replies, name);
    if (atomic_load(&service->draining))
        snprintf(message, sizeof message, "the server is shutting down: ask another one");
    else
        snprintf(message, sizeof message, "%u requests are waiting: ask again later",
                 service->settings->queue_capacity);
    reply_at_once(service, name, PERCUSS_BUSY, message);
}

/* Answers what has been asked before, and what misuses its number. True: the request is new. */
static bool admit(struct service *service, const struct request_name *name, struct digest content,
                  double now)
{
    struct answer *stored;
    char message[160];
    switch (reply_store_admit(service->replies, name, content, now, &stored)) {
    case ADMISSION_REPEATED:
        endpoint_reply(service->endpoint, name->client, stored);
        answer_release(stored);
        return false;
    case ADMISSION_CONFLICT:
        snprintf(message, sizeof message,
                 "sequence: %llu: was used for another request: must be a new number",
                 (unsigned long long)name->sequence);
        reply_at_once(service, name, PERCUSS_BAD_REQUEST, message);
        return false;
    case ADMISSION_PENDING:
        return false;
    case ADMISSION_NEW:
        break;
    }
    return true;
}

static bool is_at_least(const percuss_v1_Options *options, double tolerance)
{
    return options->tolerance == 0.0 || options->tolerance >= tolerance;
}

static bool is_long(const percuss_v1_Options *options)
{
    return options->method != PERCUSS_METHOD_MODAL ||
           options->contact_model > PERCUSS_CONTACT_TABLE || !is_at_least(options, short_tolerance);
}

static bool is_durable(const struct service *service, const percuss_v1_Request *request)
{
    return service->specimens && specimen_lane_concerns(request);
}

/* A batch is as long as its longest member, its specimens are refused by any worker; ensembles are
 * long. */
static enum lane lane_for(const struct service *service, const struct job *job)
{
    size_t i = 0, count = job->count;
    const percuss_v1_Request *requests = job->requests;
    if (job->exchange == EXCHANGE_SINGLE && !job->ensemble && is_durable(service, requests))
        return LANE_SPECIMENS;
    while (i < count && !is_long(&requests[i].options) &&
           !table_cache_lacks(&service->tables, job->snapshot->set, &requests[i]))
        i++;
    return i < count || job->ensemble ? LANE_LONG : LANE_SHORT;
}

/* Hands a job (NULL: it could not be made) to the workers, or refuses it at once. */
static void enqueue(struct service *service, const struct request_name *name, struct job *job,
                    double arrival)
{
    if (!job) {
        turn_away(service, name);
        return;
    }
    memcpy(job->client, name->client, sizeof job->client);
    job->sequence = name->sequence;
    job->arrival = arrival;
    job->snapshot = snapshots_hold(&service->snapshots);
    if (job->ensemble)
        ensembles_enter(&service->ensembles, job);
    if (!queue_put(service->lanes[lane_for(service, job)], job)) {
        if (job->ensemble)
            ensembles_leave(&service->ensembles, job);
        snapshots_release(&service->snapshots, job->snapshot);
        job_free(job);
        turn_away(service, name);
    }
}

static void enqueue_requests(struct service *service, const struct request_name *name,
                             const percuss_v1_Request *requests, size_t count, double arrival)
{
    bool draining = atomic_load(&service->draining);
    enqueue(service, name, draining ? NULL : job_create(name->exchange, requests, count), arrival);
}

static bool is_cheap(const percuss_v1_Request *request)
{
    const percuss_v1_Options *options = &request->options;
    return request->contacts._length <= 1 && options->method == PERCUSS_METHOD_MODAL &&
           options->contact_model <= PERCUSS_CONTACT_CLOSED_FORM && !options->conditioning &&
           !options->trace && is_at_least(options, cheap_tolerance);
}

/* Whether no other client has asked lately: while the reading thread solves, nobody else is heard.
 */
static bool is_sole(struct service *service, const uint8_t client[16], double now)
{
    if (memcmp(service->last_client, client, sizeof service->last_client) != 0)
        service->company_until = now + company_seconds;
    memcpy(service->last_client, client, sizeof service->last_client);
    return now >= service->company_until;
}

/* How long a solve may keep the reading thread: nobody else is heard meanwhile. */
struct patience {
    double end; /* monotonic, s */
    bool over;
};

static enum percuss_status is_quick(void *context, struct fault *fault)
{
    struct patience *patience = context;
    patience->over = clock_now() > patience->end;
    return patience->over ? fault_set(fault, PERCUSS_BUSY, "for the workers") : PERCUSS_OK;
}

/* False: it takes longer than the reading thread has; nothing is answered yet. */
static bool answer_here(struct service *service, const struct request_name *name,
                        const percuss_v1_Request *request, double arrival)
{
    struct patience patience = {.end = arrival + inline_seconds};
    struct snapshot *snapshot = snapshots_hold(&service->snapshots);
    struct question question = {
        .request = request,
        .set = snapshot->set,
        .envelope = service_envelope(service, name, snapshot),
        .arrival = arrival,
        .still_wanted = is_quick,
        .context = &patience,
    };
    struct answer *answer = responder_answer(service->inline_responder, service->tokens, &question);
    if (!patience.over)
        service_deliver(service, name, answer);
    answer_release(answer);
    snapshots_release(&service->snapshots, snapshot);
    return !patience.over;
}

static void receive_single(void *context, const percuss_v1_Request *request, bool alone)
{
    struct service *service = context;
    double arrival = clock_now();
    struct request_name name = {request->client, EXCHANGE_SINGLE, request->sequence};
    if (request->sequence == 0) {
        reply_at_once(service, &name, PERCUSS_OK, "");
        return;
    }
    if (!admit(service, &name, question_digest_single(request), arrival))
        return;
    bool sole = is_sole(service, request->client, arrival);
    bool here = alone && sole && service->settings->inline_solves && is_cheap(request) &&
                !is_durable(service, request) && !atomic_load(&service->draining) &&
                queue_length(service->lanes[LANE_SHORT]) == 0;
    /* what does not end soon the workers solve from its beginning: the same bits */
    if (!here || !answer_here(service, &name, request, arrival))
        enqueue_requests(service, &name, request, 1, arrival);
}

static void receive_batch(void *context, const percuss_v1_BatchRequest *batch)
{
    struct service *service = context;
    double arrival = clock_now();
    struct request_name name = {batch->client, EXCHANGE_BATCH, batch->sequence};
    if (batch->sequence == 0)
        reply_at_once(service, &name, PERCUSS_BAD_REQUEST, "sequence: 0: must be > 0 for a batch");
    else if (batch->requests._length == 0)
        reply_at_once(service, &name, PERCUSS_BAD_REQUEST,
                      "requests: none given: must be 1 to 256");
    else if (admit(service, &name, question_digest_batch(batch), arrival))
        enqueue_requests(service, &name, batch->requests._buffer, batch->requests._length, arrival);
}

static void receive_ensemble(void *context, const percuss_v1_EnsembleRequest *request)
{
    struct service *service = context;
    double arrival = clock_now();
    struct request_name name = {request->client, EXCHANGE_ENSEMBLE, request->sequence};
    if (request->cancel) {
        ensembles_cancel(&service->ensembles, request->client, request->sequence);
        return;
    }
    if (request->sequence == 0) {
        reply_at_once(service, &name, PERCUSS_BAD_REQUEST,
                      "sequence: 0: must be > 0 for an ensemble");
        return;
    }
    if (!admit(service, &name, question_digest_ensemble(request), arrival))
        return;
    bool draining = atomic_load(&service->draining);
    enqueue(service, &name, draining ? NULL : job_create_ensemble(request), arrival);
}

/* In its turn among the requests; a client that sees no effect asks again. */
static void receive_clear(void *context, const char *specimen)
{
    static const percuss_v1_Request nothing;
    struct service *service = context;
    if (!specimen[0] || atomic_load(&service->draining))
        return;
    struct job *job = job_create(EXCHANGE_SINGLE, &nothing, 1);
    if (!job)
        return;
    snprintf(job->clears, sizeof job->clears, "%s", specimen);
    job->snapshot = snapshots_hold(&service->snapshots);
    if (!queue_put(service->lanes[LANE_SPECIMENS], job)) {
        snapshots_release(&service->snapshots, job->snapshot);
        job_free(job);
    }
}

static void note_presence(void *context, const uint8_t client[16], bool present)
{
    struct service *service = context;
    char name[WIRE_PARTITION_SIZE];
    wire_partition_name(client, name);
    log_line(LEVEL_DEBUG, "client %s: a reader of replies has %s", name, present ? "come" : "gone");
    reply_store_set_present(service->replies, client, present, clock_now());
}

struct endpoint_handler dispatch_handler(struct service *service)
{
    return (struct endpoint_handler){
        .context = service,
        .single = receive_single,
        .batch = receive_batch,
        .ensemble = receive_ensemble,
        .clear = receive_clear,
        .presence = note_presence,
    };
}
