/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/delivery.h"

#include "daemon/log.h"
#include "endpoint/encode.h"

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

static struct answer *refusal(const struct envelope *envelope, enum exchange exchange,
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
    struct answer *answer = refusal(&envelope, name->exchange, status, message);
    snapshots_release(&shared->snapshots, snapshot);
    if (!answer) {
        log_line(LEVEL_ERROR, "request %llu: no memory for its reply",
                 (unsigned long long)name->sequence);
        return;
    }
    endpoint_reply(shared->endpoint, name->client, answer);
    answer_release(answer);
    if (status != PERCUSS_OK)
        atomic_fetch_add(&shared->refused, 1);
}

static void count(struct shared *shared, const struct answer *answer)
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
    count(shared, answer);
    /* stored first: who has seen the reply finds it when asking again */
    if (answer->passing)
        reply_store_forget(shared->replies, name);
    else
        reply_store_keep(shared->replies, name, answer);
    if (endpoint_reply(shared->endpoint, name->client, answer) != DELIVERY_DONE)
        atomic_fetch_add(&shared->undelivered, 1);
}
