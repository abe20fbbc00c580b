/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/impact_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "daemon/cost.h"
#include "daemon/delivery.h"
#include "daemon/queue.h"
#include "daemon/specimen_lane.h"
#include "daemon/status.h"
#include "exchange/batch.h"
#include "exchange/clock.h"
#include "exchange/encode.h"
#include "exchange/key_map.h"
#include "exchange/question.h"
#include "respond/responder.h"

/* Each request is an item. */
struct impact_job {
    struct client_job base;
    atomic_bool cancelled;
    percuss_v1_Request *requests; /* copies */
    struct answer *answers[];     /* of the requests; NULL: not yet, or no memory for it */
};

/* What takes longer than this, s, makes way where other clients wait. Most impacts take less than
 * a tenth of it; what is done twice, for a little longer, costs at most as much again. */
static const double MAKING_WAY = 0.01;

/* Whoever watches over an item. */
struct attempt {
    struct impact_job *impact;
    double begun;   /* monotonic, s; INFINITY: it may take its time */
    bool makes_way; /* it was given up for others */
};

/* Whether it is somebody else's turn. */
static bool makes_way(struct attempt *attempt)
{
    struct job *job = &attempt->impact->base.job;
    attempt->makes_way =
        clock_now() > attempt->begun + MAKING_WAY && queue_others_wait(job->queue, job);
    return attempt->makes_way;
}

static enum percuss_status is_wanted(void *context, struct fault *fault)
{
    struct attempt *attempt = context;
    struct impact_job *impact = attempt->impact;
    if (atomic_load(&impact->cancelled))
        return fault_set(fault, PERCUSS_BUSY, SHARED_SHUTTING_DOWN);
    if (client_job_is_withdrawn(&impact->base))
        return fault_set(fault, PERCUSS_TIMEOUT, SHARED_WITHDRAWN);
    if (client_job_is_gone(&impact->base))
        return fault_set(fault, PERCUSS_TIMEOUT, SHARED_CLIENT_GONE);
    if (makes_way(attempt))
        return fault_set(fault, PERCUSS_BUSY, "for those who take their time");
    return PERCUSS_OK;
}

static struct question question_of(struct attempt *attempt, size_t item)
{
    struct impact_job *impact = attempt->impact;
    struct client_job *base = &impact->base;
    struct question question = {
        .request = &impact->requests[item],
        .snapshot = base->snapshot,
        .envelope = client_job_envelope(base),
        .arrival = base->arrival,
        .in_batch = base->name.exchange == EXCHANGE_BATCH,
        .still_wanted = is_wanted,
        .context = attempt,
        .done = &base->done,
    };
    question.envelope.sequence = impact->requests[item].sequence;
    return question;
}

static bool run_impact(struct job *job, size_t item, struct responder *responder)
{
    struct impact_job *impact = (struct impact_job *)job;
    struct attempt attempt = {impact, responder->lane == LANE_SHORT ? clock_now() : INFINITY,
                              false};
    struct question question = question_of(&attempt, item);
    atomic_fetch_add(&impact->base.running, 1);
    struct answer *answer = responder_answer(responder, &question);
    atomic_fetch_sub(&impact->base.running, 1);
    /* what was given up on the way says nothing */
    if (attempt.makes_way)
        answer_release(answer);
    else
        impact->answers[item] = answer;
    return !attempt.makes_way;
}

static void refuse_impact(struct job *job, size_t item)
{
    struct impact_job *impact = (struct impact_job *)job;
    struct envelope envelope = client_job_envelope(&impact->base);
    char message[DELIVERY_MESSAGE];
    envelope.sequence = impact->requests[item].sequence;
    impact->answers[item] =
        encode_refusal(&envelope, PERCUSS_BUSY, delivery_too_many(impact->base.shared, message));
}

static bool run_on_specimens(struct job *job, size_t item, struct responder *responder)
{
    struct impact_job *impact = (struct impact_job *)job;
    struct shared *shared = impact->base.shared;
    struct attempt attempt = {impact, INFINITY, false};
    struct question question = question_of(&attempt, item);
    size_t before = specimen_lane_count(shared->specimens);
    atomic_fetch_add(&impact->base.running, 1);
    impact->answers[item] = specimen_lane_answer(shared->specimens, responder, &question);
    atomic_fetch_sub(&impact->base.running, 1);
    /* who has seen the reply finds its specimen announced */
    if (specimen_lane_count(shared->specimens) != before)
        status_announce(shared);
    return true;
}

static void report_impact(struct job *job)
{
    struct impact_job *impact = (struct impact_job *)job;
    client_job_deliver(&impact->base, impact->answers[0]);
}

/* The replies as one answer, in the order of the requests; NULL: no memory. */
static struct answer *gather(struct impact_job *impact)
{
    size_t count = impact->base.job.items;
    struct envelope envelope = client_job_envelope(&impact->base);
    for (size_t i = 0; i < count; i++) {
        if (!impact->answers[i])
            return NULL;
    }
    struct answer *answer = batch_answer(&envelope, impact->answers, count);
    /* it has taken the references over */
    if (answer)
        memset(impact->answers, 0, count * sizeof *impact->answers);
    return answer;
}

static void report_batch(struct job *job)
{
    struct impact_job *impact = (struct impact_job *)job;
    struct answer *answer = gather(impact);
    client_job_deliver(&impact->base, answer);
    answer_release(answer);
}

/* Only the server's end does. */
static void cancel(struct job *job)
{
    atomic_store(&((struct impact_job *)job)->cancelled, true);
}

static void release(struct job *job)
{
    struct impact_job *impact = (struct impact_job *)job;
    for (size_t i = 0; i < job->items; i++)
        answer_release(impact->answers[i]);
    client_job_end(&impact->base);
    free(impact->requests);
    free(impact);
}

/* One that waits for tables is told from others by its lane. */
static bool describe(const struct job *job, struct task *task)
{
    const struct client_job *base = (const struct client_job *)job;
    uint32_t kind = base->lane == LANE_TABLES               ? percuss_v1_TASK_TABLES
                    : base->name.exchange == EXCHANGE_BATCH ? percuss_v1_TASK_BATCH
                                                            : percuss_v1_TASK_REQUEST;
    return client_job_describe(base, kind, task);
}

static const struct job_kind impact_kind = {run_impact, refuse_impact, report_impact,      cancel,
                                            release,    describe,      client_job_withdraw};
static const struct job_kind batch_kind = {run_impact, refuse_impact, report_batch,       cancel,
                                           release,    describe,      client_job_withdraw};
static const struct job_kind specimen_kind = {
    run_on_specimens, refuse_impact, report_impact, cancel, release, describe, client_job_withdraw};

bool impact_job_is_durable(const struct shared *shared, const percuss_v1_Request *request)
{
    return shared->specimens && specimen_lane_concerns(request);
}

/* A batch is as long as its longest member. */
static enum lane lane_for(const struct client_job *job, const percuss_v1_Request *requests,
                          size_t count)
{
    enum lane lane = LANE_SHORT;
    for (size_t i = 0; i < count; i++) {
        if (table_cache_lacks(job->snapshot->tables, job->snapshot->set, &requests[i]))
            return LANE_TABLES;
        if (cost_is_long(&requests[i].options))
            lane = LANE_LONG;
    }
    return lane;
}

struct client_job *impact_job_create(struct shared *shared, const struct request_name *name,
                                     const percuss_v1_Request *requests, size_t count,
                                     double arrival)
{
    struct impact_job *impact = calloc(1, sizeof *impact + count * sizeof *impact->answers);
    if (!impact)
        return NULL;
    impact->requests = question_copy(requests, count);
    if (!impact->requests) {
        free(impact);
        return NULL;
    }
    struct client_job *base = &impact->base;
    client_job_begin(base, shared, name, arrival);
    /* the specimens that a batch names are refused by any worker */
    bool in_batch = name->exchange == EXCHANGE_BATCH;
    bool durable = !in_batch && impact_job_is_durable(shared, requests);
    base->lane = durable ? LANE_SPECIMENS : lane_for(base, requests, count);
    const struct job_kind *single_kind = durable ? &specimen_kind : &impact_kind;
    job_init(&base->job, in_batch ? &batch_kind : single_kind, count,
             digest_of_octets(name->client));
    return base;
}
