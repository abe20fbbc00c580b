/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "asking.h"

#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "desk.h"
#include "error.h"
#include "exchange/encode.h"
#include "library.h"
#include "moment.h"
#include "specimens.h"

void asking_address(struct percuss_client *client, uint64_t sequence, percuss_v1_Request *wire)
{
    memcpy(wire->client, client->id, sizeof wire->client);
    memcpy(wire->server, INSTANCE_SERVER, sizeof wire->server);
    wire->sequence = instance_draw_sequences(client, sequence, 1);
}

enum percuss_result asking_timeout(uint64_t sequence)
{
    return error_set(PERCUSS_RESULT_TIMEOUT, "request %llu is not answered in time",
                     (unsigned long long)sequence);
}

static struct answer *solve_at(struct percuss_client *client, struct desk *desk,
                               const percuss_v1_Request *wire, bool in_batch)
{
    const struct question question = {
        .request = wire,
        .snapshot = client->snapshot,
        .envelope = {wire->client, INSTANCE_SERVER, wire->sequence, client->snapshot->set->revision,
                     PERCUSS_VERSION},
        .arrival = moment_now(),
        .in_batch = in_batch,
        .still_wanted = desk_is_wanted,
        .context = &desk->patience,
    };
    return specimens_concern(client, &question) ? specimens_answer(client, desk, &question)
                                                : responder_answer(desk->responder, &question);
}

/* As public structs; the histories first, as on the wire. */
static enum percuss_result hand_over(const struct answer *answer, struct gather *gather,
                                     struct percuss_reply *reply)
{
    for (size_t i = 0; gather && i < answer->trace_count; i++)
        gather_add(gather, &answer->traces[i]);
    return convert_reply(answer->reply, reply);
}

enum percuss_result asking_answer(struct percuss_client *client, const percuss_v1_Request *wire,
                                  bool in_batch, double deadline, struct gather *gather,
                                  struct percuss_reply *reply)
{
    struct desk *desk = desk_take(client, deadline);
    if (!desk)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a workspace");
    struct answer *answer = solve_at(client, desk, wire, in_batch);
    const struct patience patience = desk->patience;
    desk_give(client, desk);
    /* what was given up says nothing */
    enum percuss_result result = PERCUSS_RESULT_OK;
    if (!answer)
        result = error_set(PERCUSS_RESULT_NO_MEMORY, "a reply");
    else if (patience.over && answer->reply->status == PERCUSS_TIMEOUT)
        result = patience.cancelled ? watching_cancelled() : asking_timeout(wire->sequence);
    else
        result = hand_over(answer, gather, reply);
    if (result == PERCUSS_RESULT_OK)
        atomic_fetch_add(encode_status_has_result(answer->reply->status) ? &client->answered
                                                                         : &client->refused,
                         1);
    answer_release(answer);
    return result;
}

/* From the public struct on. */
static enum percuss_result ask(struct percuss_client *client, const struct percuss_request *request,
                               double timeout, struct gather *gather, struct percuss_reply *reply)
{
    struct request_storage storage;
    percuss_v1_Request wire;
    double deadline;
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = convert_request(request, &storage, &wire);
    if (result != PERCUSS_RESULT_OK)
        return result;
    asking_address(client, request->sequence, &wire);
    wire.options.trace = wire.options.trace || gather;
    return asking_answer(client, &wire, false, deadline, gather, reply);
}

enum percuss_result local_solve(struct percuss_client *client,
                                const struct percuss_request *request, double timeout,
                                struct percuss_reply *reply)
{
    *reply = (struct percuss_reply){0};
    return ask(client, request, timeout, NULL, reply);
}

enum percuss_result local_solve_traced(struct percuss_client *client,
                                       const struct percuss_request *request, double timeout,
                                       struct percuss_reply *reply, struct percuss_trace *trace)
{
    *reply = (struct percuss_reply){0};
    *trace = (struct percuss_trace){0};
    struct gather *gather = calloc(1, sizeof *gather);
    if (!gather)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a trace");
    enum percuss_result result = ask(client, request, timeout, gather, reply);
    if (result == PERCUSS_RESULT_OK)
        result = gather_collect(gather, reply->contact_count, trace);
    /* both or none */
    if (result != PERCUSS_RESULT_OK)
        percuss_reply_free(reply);
    gather_clear(gather);
    free(gather);
    return result;
}

/* All questions, one after the other. */
static enum percuss_result ask_all(struct percuss_client *client,
                                   const struct percuss_request *requests, size_t count,
                                   double deadline, struct percuss_reply *replies)
{
    struct request_storage storage;
    percuss_v1_Request wire;
    enum percuss_result result = PERCUSS_RESULT_OK;
    /* nothing is asked unless all can be: one number for the batch, and one for each question */
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < count; i++)
        result = convert_request(&requests[i], &storage, &wire);
    uint64_t sequence = instance_draw_sequences(client, 0, count + 1);
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < count; i++) {
        convert_request(&requests[i], &storage, &wire);
        memcpy(wire.client, client->id, sizeof wire.client);
        wire.sequence = sequence + 1 + i;
        result = asking_answer(client, &wire, true, deadline, NULL, &replies[i]);
    }
    return result;
}

enum percuss_result local_solve_batch(struct percuss_client *client,
                                      const struct percuss_request *requests, size_t count,
                                      double timeout, struct percuss_reply *replies)
{
    double deadline;
    if (count < 1 || count > PERCUSS_MAX_BATCH)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "count: %zu: 1..%d is allowed", count,
                         PERCUSS_MAX_BATCH);
    memset(replies, 0, count * sizeof *replies);
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = ask_all(client, requests, count, deadline, replies);
    /* all or none */
    for (size_t i = 0; result != PERCUSS_RESULT_OK && i < count; i++)
        percuss_reply_free(&replies[i]);
    return result;
}
