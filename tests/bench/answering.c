/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "answering.h"

#include <dds/ddsi/ddsi_cdrstream.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert.h"
#include "daemon/shared.h"
#include "endpoint/reply_bytes.h"
#include "exchange/clock.h"
#include "exchange/decode.h"
#include "exchange/encode.h"
#include "exchange/question.h"

/* What DDS puts before the data of a sample: how it is serialised. */
enum { WIRE_HEAD = 4, XCDR2 = 2 };

struct answering {
    struct settings settings;
    struct shared shared;
    struct responder *responder;
    uint8_t server[16];
    uint64_t sequence; /* of the question at hand */
    percuss_v1_Request wire;
    struct request_storage storage;
    struct percuss_request request;
    struct answer *last;
};

struct answering *answering_create(const char *settings)
{
    struct fault fault;
    struct answering *answering = calloc(1, sizeof *answering);
    if (!answering)
        return NULL;
    answering->settings = settings_default();
    bool good = settings_load(settings, &answering->settings, &fault) == PERCUSS_OK &&
                shared_create(&answering->shared, &answering->settings, &fault);
    if (good)
        answering->responder = shared_responder(&answering->shared, false);
    if (answering->responder)
        return answering;
    fprintf(stderr, "%s\n", good ? "out of memory" : fault.text);
    if (good)
        shared_release(&answering->shared);
    free(answering);
    return NULL;
}

void answering_free(struct answering *answering)
{
    if (!answering)
        return;
    answer_release(answering->last);
    responder_free(answering->responder);
    shared_release(&answering->shared);
    free(answering);
}

bool answering_put(struct answering *answering, const struct query *query, unsigned long variation)
{
    query_fill(query, variation, &answering->request);
    if (convert_request(&answering->request, &answering->storage, &answering->wire))
        return false;
    answering->wire.sequence = ++answering->sequence;
    return true;
}

static enum percuss_status anybody(void *context, struct fault *fault)
{
    (void)context;
    (void)fault;
    return PERCUSS_OK;
}

bool answering_answer(struct answering *answering)
{
    struct shared *shared = &answering->shared;
    const percuss_v1_Request *wire = &answering->wire;
    double arrival = clock_now();
    struct request_name name = {wire->client, EXCHANGE_SINGLE, wire->sequence};
    struct answer *stored;
    if (reply_store_admit(shared->replies, &name, question_digest_single(wire), arrival, &stored))
        return false;
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    struct question question = {
        .request = wire,
        .snapshot = snapshot,
        .envelope = {wire->client, answering->server, wire->sequence, snapshot->set->revision,
                     PERCUSS_VERSION},
        .arrival = arrival,
        .still_wanted = anybody,
    };
    struct answer *answer = responder_answer(answering->responder, &question);
    if (answer)
        reply_store_keep(shared->replies, &name, answer);
    answer_release(answering->last);
    answering->last = answer;
    snapshots_release(&shared->snapshots, snapshot);
    bool good = answer && encode_status_has_result(answer->reply->status);
    if (!good)
        fprintf(stderr, "%s\n", answer ? answer->reply->message : "no answer");
    return good;
}

/* What callgrind counts: everything this function does and calls. */
__attribute__((noinline)) bool counted_answer(struct answering *answering);

bool counted_answer(struct answering *answering)
{
    return answering_answer(answering);
}

bool answering_count(struct answering *answering)
{
    return counted_answer(answering);
}

bool answering_solve(struct answering *answering)
{
    struct responder *responder = answering->responder;
    const struct snapshot *snapshot = answering->shared.snapshots.current;
    const struct solve_context means = {.catalogue = snapshot->set,
                                        .tables = table_store_source(snapshot->tables->loaded)};
    return solve(responder->workspace, &means, &responder->request, &responder->result) ==
           PERCUSS_OK;
}

void answering_sizes(const struct answering *answering, size_t *question, size_t *reply)
{
    dds_ostreamLE_t stream;
    dds_ostreamLE_init(&stream, 0, XCDR2);
    dds_stream_writeLE(&stream, (const char *)&answering->wire, percuss_v1_Request_desc.m_ops);
    *question = stream.x.m_index + WIRE_HEAD;
    dds_ostreamLE_fini(&stream);
    free(reply_bytes_write(answering->last, reply));
    *reply += WIRE_HEAD;
}
