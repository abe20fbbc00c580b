/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/delivery.h"

#include <stdio.h>

#include "daemon/log.h"
#include "exchange/encode.h"

struct envelope delivery_envelope(const struct shared *shared, const struct request_name *name,
                                  const struct snapshot *snapshot)
{
    return (struct envelope){
        .client = name->client,
        .server = endpoint_server(shared->endpoint),
        .sequence = name->sequence,
        .revision = snapshot->set->revision,
        .version = PERCUSS_VERSION,
    };
}

static const char *const KINDS[EXCHANGE_COUNT] = {
    [EXCHANGE_SINGLE] = "request", [EXCHANGE_BATCH] = "batch", [EXCHANGE_ENSEMBLE] = "ensemble"};

static void delivery_note_refusal(const struct request_name *name, enum percuss_status status,
                                  const char *message)
{
    struct log_request about = {name->client, name->sequence};
    log_about(LEVEL_DEBUG, &about, "%s: %s: %s", KINDS[name->exchange], status_name(status),
              message);
}

static void delivery_note_answer(const struct request_name *name, const struct answer *answer)
{
    if (!log_shows(LEVEL_DEBUG))
        return;
    struct log_request about = {name->client, name->sequence};
    if (answer->report)
        log_about(LEVEL_DEBUG, &about, "ensemble: %s%s%s", status_name(answer->report->status),
                  answer->report->message[0] ? ": " : "", answer->report->message);
    else if (answer->exchange == EXCHANGE_BATCH)
        log_about(LEVEL_DEBUG, &about, "batch of %zu: %s", answer->member_count,
                  status_name(answer->parts->status));
    else
        log_about(LEVEL_DEBUG, &about, "%s: %s%s%s; waited %.3f ms, solved in %.3f ms",
                  KINDS[name->exchange], status_name(answer->reply->status),
                  answer->reply->message[0] ? ": " : "", answer->reply->message,
                  1e3 * answer->reply->timing.queue, 1e3 * answer->reply->timing.solve);
}

static struct answer *delivery_refusal(const struct envelope *envelope, enum exchange exchange,
                                       enum percuss_status status, const char *message)
{
    if (exchange == EXCHANGE_BATCH)
        return encode_batch_refusal(envelope, status, message);
    if (exchange == EXCHANGE_ENSEMBLE)
        return encode_ensemble_refusal(envelope, status, message);
    return encode_refusal(envelope, status, message);
}

void deliver_at_once(struct shared *shared, const struct request_name *name,
                     enum percuss_status status, const char *message)
{
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    struct envelope envelope = delivery_envelope(shared, name, snapshot);
    struct answer *answer = delivery_refusal(&envelope, name->exchange, status, message);
    snapshots_release(&shared->snapshots, snapshot);
    if (!answer) {
        log_about(LEVEL_ERROR, &(struct log_request){name->client, name->sequence},
                  "no memory for its reply");
        return;
    }
    endpoint_reply(shared->endpoint, name->client, answer);
    answer_release(answer);
    if (status == PERCUSS_OK) {
        atomic_fetch_add(&shared->metrics.pings, 1);
        return;
    }
    delivery_note_refusal(name, status, message);
    atomic_fetch_add(&shared->refused, 1);
    metrics_count_refusal(&shared->metrics, name->exchange, status);
}

const char *delivery_too_many(const struct shared *shared, char message[DELIVERY_MESSAGE])
{
    snprintf(message, DELIVERY_MESSAGE, "%u requests are waiting: ask again later",
             shared->settings->queue_capacity);
    return message;
}

void deliver_refusal(struct shared *shared, const struct request_name *name,
                     enum percuss_status status, const char *message)
{
    reply_store_forget(shared->replies, name);
    deliver_at_once(shared, name, status, message);
}

static void delivery_count(struct shared *shared, const struct answer *answer)
{
    unsigned long long answered = 0, all = 1;
    if (answer->exchange == EXCHANGE_BATCH && answer->member_count > 0)
        all = answer->member_count;
    for (size_t i = 0; answer->reply && i < all; i++)
        answered += encode_status_has_result(answer->reply[i].status);
    if (answer->exchange == EXCHANGE_ENSEMBLE)
        answered = encode_status_has_result(answer->report->status);
    atomic_fetch_add(&shared->answered, answered);
    atomic_fetch_add(&shared->refused, all - answered);
}

void deliver(struct shared *shared, const struct request_name *name, struct answer *answer)
{
    if (!answer) {
        reply_store_forget(shared->replies, name);
        deliver_at_once(shared, name, PERCUSS_INTERNAL, "out of memory");
        return;
    }
    delivery_count(shared, answer);
    metrics_count(&shared->metrics, answer);
    delivery_note_answer(name, answer);
    /* stored first: a client that has the reply gets the same one when it asks again */
    if (answer->passing)
        reply_store_forget(shared->replies, name);
    else
        reply_store_keep(shared->replies, name, answer);
    if (endpoint_reply(shared->endpoint, name->client, answer) != DELIVERY_DONE)
        atomic_fetch_add(&shared->undelivered, 1);
}
