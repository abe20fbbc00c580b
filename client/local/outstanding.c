/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Questions to the solver in this process: at once, in batches and outstanding. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "desk.h"
#include "error.h"
#include "exchange/encode.h"
#include "exchange/question.h"
#include "gather.h"
#include "instance.h"
#include "library.h"
#include "moment.h"
#include "specimens.h"

/* One question, from the wire's struct to a reply. */

/* Puts the client's id and a number, drawn unless the request has one, on a converted request. */
static void asking_address(struct percuss_client *client, uint64_t sequence,
                           percuss_v1_Request *wire)
{
    memcpy(wire->client, client->id, sizeof wire->client);
    memcpy(wire->server, INSTANCE_SERVER, sizeof wire->server);
    wire->sequence = instance_draw_sequences(client, sequence, 1);
}

/* That a request was not answered in time. */
static enum percuss_result asking_timeout(uint64_t sequence)
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

/* Answers a question with its client and sequence set. TIMEOUT: the patience is over; NO_MEMORY.
 * `gather` NULL: histories are not wanted. */
static enum percuss_result asking_answer(struct percuss_client *client,
                                         const percuss_v1_Request *wire, bool in_batch,
                                         double deadline, struct gather *gather,
                                         struct percuss_reply *reply)
{
    struct desk *desk = desk_take(client, deadline);
    if (!desk)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a workspace");
    struct answer *answer = solve_at(client, desk, wire, in_batch);
    const struct patience patience = desk->patience;
    desk_give(client, desk);
    /* a question that was given up has no error */
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

enum { MOST_OUTSTANDING = 1024 };

struct outstanding {
    uint64_t sequence;
    percuss_v1_Request *wire; /* a copy */
    bool taken;               /* a thread solves it */
    struct outstanding *next;
};

/* The question of that number, or with 0 the first that no thread solves; the lock is held. */
static struct outstanding *outstanding_find(struct percuss_client *client, uint64_t sequence)
{
    struct outstanding *one = client->first;
    while (one && (sequence ? one->sequence != sequence : one->taken))
        one = one->next;
    return one;
}

static void append(struct percuss_client *client, struct outstanding *one)
{
    *(client->last ? &client->last->next : &client->first) = one;
    client->last = one;
    client->outstanding_count++;
}

static void release(struct outstanding *one)
{
    free(one->wire);
    free(one);
}

/* Takes it out and frees it; the lock is held. */
static void remove_one(struct percuss_client *client, struct outstanding *one)
{
    struct outstanding **link = &client->first, *before = NULL;
    for (; *link != one; link = &(*link)->next)
        before = *link;
    *link = one->next;
    if (client->last == one)
        client->last = before;
    client->outstanding_count--;
    release(one);
}

void outstanding_clear(struct percuss_client *client)
{
    while (client->first)
        remove_one(client, client->first);
}

/* Enters a question; the lock is held. One that is outstanding already is asked once. */
static enum percuss_result enter(struct percuss_client *client, struct outstanding *one)
{
    struct outstanding *same = outstanding_find(client, one->sequence);
    if (same && same->taken)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "sequence: %llu: another thread waits for it",
                         (unsigned long long)one->sequence);
    if (!same && client->outstanding_count >= MOST_OUTSTANDING)
        return error_set(PERCUSS_RESULT_WINDOW_FULL,
                         "%zu requests are outstanding; collect or cancel some",
                         client->outstanding_count);
    if (same)
        remove_one(client, same);
    append(client, one);
    return PERCUSS_RESULT_OK;
}

enum percuss_result local_submit(struct percuss_client *client,
                                 const struct percuss_request *request, uint64_t *sequence)
{
    struct request_storage storage;
    percuss_v1_Request wire;
    enum percuss_result result = convert_request(request, &storage, &wire);
    if (result != PERCUSS_RESULT_OK)
        return result;
    asking_address(client, request->sequence, &wire);
    /* nothing of the request is kept */
    struct outstanding *one = calloc(1, sizeof *one);
    if (one)
        one->wire = question_copy(&wire, 1);
    if (!one || !one->wire) {
        free(one);
        return error_set(PERCUSS_RESULT_NO_MEMORY, "an outstanding request");
    }
    one->sequence = wire.sequence;
    pthread_mutex_lock(&client->lock);
    result = enter(client, one);
    pthread_mutex_unlock(&client->lock);
    if (result != PERCUSS_RESULT_OK)
        release(one);
    else if (sequence)
        *sequence = wire.sequence;
    return result;
}

/* The question that this thread may solve; the lock is held. */
static enum percuss_result take(struct percuss_client *client, uint64_t sequence,
                                struct outstanding **one)
{
    *one = outstanding_find(client, sequence);
    if (!*one && sequence == 0)
        return error_set(PERCUSS_RESULT_UNKNOWN_SEQUENCE, "no request is outstanding");
    if (*one && !(*one)->taken)
        return PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_UNKNOWN_SEQUENCE, "sequence: %llu: %s",
                     (unsigned long long)sequence,
                     *one ? "another thread waits for it" : "no such request is outstanding");
}

/* Solves it in this thread. Given up, it stays outstanding. */
static enum percuss_result solve_one(struct percuss_client *client, uint64_t sequence,
                                     double deadline, struct percuss_reply *reply)
{
    struct outstanding *one;
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = take(client, sequence, &one);
    if (result == PERCUSS_RESULT_OK) {
        one->taken = true;
        pthread_mutex_unlock(&client->lock);
        result = asking_answer(client, one->wire, false, deadline, NULL, reply);
        pthread_mutex_lock(&client->lock);
        one->taken = false;
        if (result == PERCUSS_RESULT_OK)
            remove_one(client, one);
    }
    pthread_mutex_unlock(&client->lock);
    return result;
}

enum percuss_result local_wait(struct percuss_client *client, uint64_t sequence, double timeout,
                               struct percuss_reply *reply)
{
    double deadline;
    *reply = (struct percuss_reply){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    return result ? result : solve_one(client, sequence, deadline, reply);
}

enum percuss_result local_poll(struct percuss_client *client, uint64_t sequence,
                               struct percuss_reply *reply)
{
    *reply = (struct percuss_reply){0};
    return solve_one(client, sequence, INFINITY, reply);
}

enum percuss_result local_cancel(struct percuss_client *client, uint64_t sequence)
{
    struct outstanding *one;
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = sequence
                                     ? take(client, sequence, &one)
                                     : error_set(PERCUSS_RESULT_UNKNOWN_SEQUENCE,
                                                 "sequence: 0: no such request is outstanding");
    if (result == PERCUSS_RESULT_OK)
        remove_one(client, one);
    pthread_mutex_unlock(&client->lock);
    return result;
}
