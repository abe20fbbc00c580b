/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "outstanding.h"

#include <math.h>
#include <stdlib.h>

#include "asking.h"
#include "convert.h"
#include "error.h"
#include "exchange/question.h"
#include "library.h"
#include "moment.h"

enum { MOST_OUTSTANDING = 1024 };

struct outstanding {
    uint64_t sequence;
    percuss_v1_Request *wire; /* a copy */
    bool taken;               /* a thread solves it */
    struct outstanding *next;
};

/* The question of that number, or with 0 the first that nobody solves; the lock is held. */
static struct outstanding *find(struct percuss_client *client, uint64_t sequence)
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
    struct outstanding *same = find(client, one->sequence);
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
    *one = find(client, sequence);
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
