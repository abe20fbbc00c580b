/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/client_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "contact/law.h"
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

/* Finer tolerances take tens of milliseconds, or seconds. */
static const double CHEAP_TOLERANCE = 1e-4, SHORT_TOLERANCE = 1e-9;

static bool cost_takes(const percuss_v1_Options *options, enum contact_effort effort)
{
    return contact_law_asked(options->contact_model)->effort == effort;
}

static bool cost_is_at_least(const percuss_v1_Options *options, double tolerance)
{
    return options->tolerance == 0.0 || options->tolerance >= tolerance;
}

bool impact_job_is_cheap(const percuss_v1_Request *request)
{
    const percuss_v1_Options *options = &request->options;
    return request->contacts._length <= 1 && options->method == PERCUSS_METHOD_MODAL &&
           cost_takes(options, CONTACT_EFFORT_LEAST) && !options->conditioning && !options->trace &&
           cost_is_at_least(options, CHEAP_TOLERANCE);
}

bool impact_job_is_long(const percuss_v1_Options *options)
{
    return options->method != PERCUSS_METHOD_MODAL || cost_takes(options, CONTACT_EFFORT_LONG) ||
           !cost_is_at_least(options, SHORT_TOLERANCE);
}

void client_job_begin(struct client_job *job, struct shared *shared,
                      const struct request_name *name, double arrival)
{
    job->shared = shared;
    memcpy(job->client, name->client, sizeof job->client);
    job->name = (struct request_name){job->client, name->exchange, name->sequence};
    job->arrival = arrival;
    job->snapshot = snapshots_hold(&shared->snapshots);
    atomic_init(&job->abandoned, false);
    atomic_init(&job->fate, FATE_OPEN);
    atomic_init(&job->running, 0);
    atomic_init(&job->done, 0.0);
}

void client_job_end(struct client_job *job)
{
    snapshots_release(&job->shared->snapshots, job->snapshot);
}

struct envelope client_job_envelope(const struct client_job *job)
{
    return delivery_envelope(job->shared, &job->name, job->snapshot);
}

bool client_job_is_gone(struct client_job *job)
{
    bool gone = reply_store_is_gone(job->shared->replies, job->client);
    if (gone)
        atomic_store(&job->abandoned, true);
    return gone;
}

/* False: it had another end before. */
static bool client_job_settle(struct client_job *job, enum client_job_fate fate)
{
    int open = FATE_OPEN;
    return atomic_compare_exchange_strong(&job->fate, &open, (int)fate);
}

bool client_job_is_withdrawn(const struct client_job *job)
{
    return atomic_load(&job->fate) == FATE_WITHDRAWN;
}

bool client_job_withdraw(struct job *job, const struct request_name *name)
{
    struct client_job *ours = (struct client_job *)job;
    if (name->exchange != ours->name.exchange || name->sequence != ours->name.sequence ||
        memcmp(name->client, ours->client, sizeof ours->client) != 0 ||
        !client_job_settle(ours, FATE_WITHDRAWN))
        return false;
    reply_store_forget(ours->shared->replies, name);
    return true;
}

void client_job_deliver(struct client_job *job, struct answer *answer)
{
    if (!client_job_settle(job, FATE_DELIVERED))
        return;
    if (atomic_load(&job->abandoned) && client_job_is_gone(job))
        reply_store_forget(job->shared->replies, &job->name);
    else
        deliver(job->shared, &job->name, answer);
}

/* The share of items that are settled; of a single item, the share that its solve reports. */
static double client_job_share_done(const struct client_job *job)
{
    size_t items = job->job.items;
    if (items > 1)
        return (double)(items - atomic_load(&job->job.left)) / (double)items;
    double done = atomic_load(&job->done);
    return done > 0.0 ? fmin(done, 1.0) : NAN;
}

bool client_job_describe(const struct client_job *job, uint32_t kind, struct task *task)
{
    *task = (struct task){
        .sequence = job->name.sequence,
        .kind = kind,
        .running = atomic_load(&job->running) > 0,
        .arrival = job->arrival,
        .done = client_job_share_done(job),
    };
    memcpy(task->client, job->client, sizeof task->client);
    return !client_job_is_withdrawn(job);
}

/* Each request is an item. */
struct impact_job {
    struct client_job base;
    atomic_bool cancelled;
    percuss_v1_Request *requests; /* copies */
    struct answer *answers[];     /* of the requests; NULL: not yet, or no memory for it */
};

/* A solve that takes longer than this, s, is given up where other clients wait. Most impacts take
 * less than a tenth of it; one that is begun twice, for a little more, costs at most as much again.
 */
static const double MAKING_WAY = 0.01;

/* One solve of an item, which asks whether it is still wanted. */
struct attempt {
    struct impact_job *impact;
    double begun;   /* monotonic, s; INFINITY: it is never given up for others */
    bool makes_way; /* it was given up for others */
};

/* Whether the item is given up for other clients. */
static bool attempt_makes_way(struct attempt *attempt)
{
    struct job *job = &attempt->impact->base.job;
    attempt->makes_way =
        clock_now() > attempt->begun + MAKING_WAY && queue_others_wait(job->queue, job);
    return attempt->makes_way;
}

static enum percuss_status attempt_is_wanted(void *context, struct fault *fault)
{
    struct attempt *attempt = context;
    struct impact_job *impact = attempt->impact;
    if (atomic_load(&impact->cancelled))
        return fault_set(fault, PERCUSS_BUSY, SHARED_SHUTTING_DOWN);
    if (client_job_is_withdrawn(&impact->base))
        return fault_set(fault, PERCUSS_TIMEOUT, SHARED_WITHDRAWN);
    if (client_job_is_gone(&impact->base))
        return fault_set(fault, PERCUSS_TIMEOUT, SHARED_CLIENT_GONE);
    if (attempt_makes_way(attempt))
        return fault_set(fault, PERCUSS_BUSY, "for those who take their time");
    return PERCUSS_OK;
}

static struct question attempt_question(struct attempt *attempt, size_t item)
{
    struct impact_job *impact = attempt->impact;
    struct client_job *base = &impact->base;
    struct question question = {
        .request = &impact->requests[item],
        .snapshot = base->snapshot,
        .envelope = client_job_envelope(base),
        .arrival = base->arrival,
        .in_batch = base->name.exchange == EXCHANGE_BATCH,
        .still_wanted = attempt_is_wanted,
        .context = attempt,
        .done = &base->done,
    };
    question.envelope.sequence = impact->requests[item].sequence;
    return question;
}

static bool impact_run(struct job *job, size_t item, struct responder *responder)
{
    struct impact_job *impact = (struct impact_job *)job;
    struct attempt attempt = {impact, responder->lane == LANE_SHORT ? clock_now() : INFINITY,
                              false};
    struct question question = attempt_question(&attempt, item);
    atomic_fetch_add(&impact->base.running, 1);
    struct answer *answer = responder_answer(responder, &question);
    responder_settle(responder);
    atomic_fetch_sub(&impact->base.running, 1);
    /* a solve that was given up has no answer */
    if (attempt.makes_way)
        answer_release(answer);
    else
        impact->answers[item] = answer;
    return !attempt.makes_way;
}

static void impact_refuse(struct job *job, size_t item)
{
    struct impact_job *impact = (struct impact_job *)job;
    struct envelope envelope = client_job_envelope(&impact->base);
    char message[DELIVERY_MESSAGE];
    envelope.sequence = impact->requests[item].sequence;
    impact->answers[item] =
        encode_refusal(&envelope, PERCUSS_BUSY, delivery_too_many(impact->base.shared, message));
}

static bool specimen_run(struct job *job, size_t item, struct responder *responder)
{
    struct impact_job *impact = (struct impact_job *)job;
    struct shared *shared = impact->base.shared;
    struct attempt attempt = {impact, INFINITY, false};
    struct question question = attempt_question(&attempt, item);
    size_t before = specimen_lane_count(shared->specimens);
    atomic_fetch_add(&impact->base.running, 1);
    impact->answers[item] = specimen_lane_answer(shared->specimens, responder, &question);
    responder_settle(responder);
    atomic_fetch_sub(&impact->base.running, 1);
    /* a client that has the reply finds its specimen announced */
    if (specimen_lane_count(shared->specimens) != before)
        status_announce(shared);
    return true;
}

static void impact_report(struct job *job)
{
    struct impact_job *impact = (struct impact_job *)job;
    client_job_deliver(&impact->base, impact->answers[0]);
}

/* The replies as one answer, in the order of the requests; NULL: no memory. */
static struct answer *batch_gather(struct impact_job *impact)
{
    size_t count = impact->base.job.items;
    struct envelope envelope = client_job_envelope(&impact->base);
    for (size_t i = 0; i < count; i++) {
        if (!impact->answers[i])
            return NULL;
    }
    struct answer *answer = batch_answer(&envelope, impact->answers, count);
    /* it owns the references now */
    if (answer)
        memset(impact->answers, 0, count * sizeof *impact->answers);
    return answer;
}

static void batch_report(struct job *job)
{
    struct impact_job *impact = (struct impact_job *)job;
    struct answer *answer = batch_gather(impact);
    client_job_deliver(&impact->base, answer);
    answer_release(answer);
}

/* Of the server's end alone; a client withdraws its request. */
static void impact_cancel(struct job *job)
{
    atomic_store(&((struct impact_job *)job)->cancelled, true);
}

static void impact_release(struct job *job)
{
    struct impact_job *impact = (struct impact_job *)job;
    for (size_t i = 0; i < job->items; i++)
        answer_release(impact->answers[i]);
    client_job_end(&impact->base);
    free(impact->requests);
    free(impact);
}

/* A request that waits for tables is one in their lane. */
static bool impact_describe(const struct job *job, struct task *task)
{
    const struct client_job *base = (const struct client_job *)job;
    uint32_t kind = base->lane == LANE_TABLES               ? percuss_v1_TASK_TABLES
                    : base->name.exchange == EXCHANGE_BATCH ? percuss_v1_TASK_BATCH
                                                            : percuss_v1_TASK_REQUEST;
    return client_job_describe(base, kind, task);
}

static const struct job_kind impact_kind = {impact_run,         impact_refuse,  impact_report,
                                            impact_cancel,      impact_release, impact_describe,
                                            client_job_withdraw};
static const struct job_kind batch_kind = {impact_run,         impact_refuse,  batch_report,
                                           impact_cancel,      impact_release, impact_describe,
                                           client_job_withdraw};
static const struct job_kind specimen_kind = {specimen_run,       impact_refuse,  impact_report,
                                              impact_cancel,      impact_release, impact_describe,
                                              client_job_withdraw};

bool impact_job_is_durable(const struct shared *shared, const percuss_v1_Request *request)
{
    return shared->specimens && specimen_lane_concerns(request);
}

/* Of a batch, the lane of its longest member. */
static enum lane impact_lane(const struct client_job *job, const percuss_v1_Request *requests,
                             size_t count)
{
    enum lane lane = LANE_SHORT;
    for (size_t i = 0; i < count; i++) {
        if (table_cache_lacks(job->snapshot->tables, job->snapshot->set, &requests[i]))
            return LANE_TABLES;
        if (impact_job_is_long(&requests[i].options))
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
    /* any worker refuses the specimens that a batch names */
    bool in_batch = name->exchange == EXCHANGE_BATCH;
    bool durable = !in_batch && impact_job_is_durable(shared, requests);
    base->lane = durable ? LANE_SPECIMENS : impact_lane(base, requests, count);
    const struct job_kind *single_kind = durable ? &specimen_kind : &impact_kind;
    job_init(&base->job, in_batch ? &batch_kind : single_kind, count,
             digest_of_octets(name->client));
    return base;
}
