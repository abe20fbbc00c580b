/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests and their replies, one at a time or many outstanding. */

#include "exchange.h"

#include <math.h>
#include <string.h>

#include "convert.h"
#include "error.h"
#include "failure.h"
#include "gather.h"
#include "library.h"
#include "moment.h"
#include "ping.h"
#include "receive.h"

/* The successor of a server that has gone: a process that answers under the same id. */

/* s from the loss of a server that ended in good order until another process has had time to take
 * its place, which takes a quarter of it where the machine has time */
static const double SUCCESSION = 0.4;
/* s after the loss of one that did not: it has been gone for a lease by then, and its successor is
 * there and only has to answer a ping */
static const double ANSWER = 0.2;

/* Whether the last word of the server was that it ends. */
static bool was_draining(const struct percuss_client *client)
{
    percuss_v1_ServerStatus status = {0};
    void *samples[1] = {&status};
    dds_sample_info_t info;
    memcpy(status.server, client->server.id, sizeof status.server);
    dds_instance_handle_t server = dds_lookup_instance(client->server_reader, &status);
    /* its announcements stay readable when it has gone */
    bool draining = server != DDS_HANDLE_NIL &&
                    dds_read_instance(client->server_reader, samples, &info, 1, 1, server) == 1 &&
                    info.valid_data && strcmp(status.state, "ready") != 0;
    /* the tasks that it had are beside the struct */
    dds_sample_free(&status, &percuss_v1_ServerStatus_desc, DDS_FREE_CONTENTS);
    return draining;
}

static bool is_followed(const struct percuss_client *client, const void *subject)
{
    (void)subject;
    return !client->lost;
}

/* Waits for a moment for the successor of a server that has gone, and stays with it; the lock is
 * held at entry and return. False: there is none. */
static bool succession_follow(struct percuss_client *client, double deadline)
{
    const double patience = was_draining(client) ? SUCCESSION : ANSWER;
    const double end = fmin(deadline, client->lost_since + patience);
    enum percuss_result result = PERCUSS_RESULT_OK;
    /* the successor answers requests that name the server */
    while (client->lost && result == PERCUSS_RESULT_OK && moment_now() < end) {
        result = ping_write(client, client->server.id);
        if (result == PERCUSS_RESULT_OK)
            result = receive_regardless(client, is_followed, NULL,
                                        fmin(end, moment_now() + PING_INTERVAL));
        if (result == PERCUSS_RESULT_TIMEOUT)
            result = PERCUSS_RESULT_OK;
    }
    return client->connected && !client->lost;
}

enum percuss_result exchange_check_connected(const struct percuss_client *client)
{
    enum percuss_result result = client_check_identity(client);
    if (result != PERCUSS_RESULT_OK)
        return result;
    if (client->connected)
        return client->lost ? failure_lost(client->server_name) : PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_NO_SERVER, "not connected: call percuss_client_connect first");
}

static bool pending_is_ready(const struct percuss_client *client, const void *subject)
{
    (void)client;
    const struct pending *pending = subject;
    return pending->ready;
}

static enum percuss_result refuse_orphan(const struct percuss_client *client,
                                         const struct pending *pending)
{
    return error_set(PERCUSS_RESULT_NO_SERVER,
                     "request %llu was asked of a process that has gone, and whose place %s has "
                     "taken: ask again with this sequence",
                     (unsigned long long)pending->sequence, client->server_name);
}

enum percuss_result exchange_await(struct percuss_client *client, const struct pending *pending,
                                   double deadline)
{
    if (pending->orphaned)
        return refuse_orphan(client, pending);
    const double start = moment_now();
    enum percuss_result result = receive_until(client, pending_is_ready, pending, deadline);
    if (result == PERCUSS_RESULT_TIMEOUT)
        error_set(result, "request %llu is not answered by %s after %.1f s",
                  (unsigned long long)pending->sequence, client->server_name, moment_now() - start);
    return result;
}

/* Enters the request, or finds it where it is repeated. */
static enum percuss_result enter(struct percuss_client *client, uint64_t sequence, bool waited,
                                 struct pending **pending)
{
    /* repeated: outstanding already, for one thread to wait for */
    *pending = sequence ? pending_find(&client->pending, sequence) : NULL;
    if (*pending && ((*pending)->waited || (*pending)->batch || (*pending)->ensemble))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "sequence: %llu: another thread waits for it",
                         (unsigned long long)sequence);
    enum percuss_result result = PERCUSS_RESULT_OK;
    /* new: with a number of ours, or the program's, beyond which ours go on */
    if (!*pending) {
        if (sequence == 0)
            sequence = client_draw_sequences(client, 1);
        else if (sequence >= client->next_sequence)
            client->next_sequence = sequence + 1;
        result = pending_add(&client->pending, sequence, pending);
    }
    if (result == PERCUSS_RESULT_OK)
        (*pending)->waited = waited;
    return result;
}

/* Writes a request that is entered; one that cannot be sent is not waited for. */
static enum percuss_result write_request(struct percuss_client *client, percuss_v1_Request *wire,
                                         struct pending *pending)
{
    /* ids of client and server */
    memcpy(wire->client, client->id, sizeof wire->client);
    memcpy(wire->server, client->server.id, sizeof wire->server);
    wire->sequence = pending->sequence;
    pending->orphaned = false;
    /* with histories if they are gathered */
    wire->options.trace = wire->options.trace || pending->gather;
    dds_return_t code = dds_write(client->request_writer, wire);
    if (code >= 0)
        return PERCUSS_RESULT_OK;
    pending_remove(&client->pending, pending);
    return failure_dds("writing the request", code);
}

/* Enters and writes a request; the lock is held. */
static enum percuss_result send_request(struct percuss_client *client,
                                        const struct percuss_request *request, bool waited,
                                        struct gather *gather, struct pending **pending)
{
    struct request_storage storage;
    percuss_v1_Request wire;
    enum percuss_result result = convert_request(request, &storage, &wire);
    if (result == PERCUSS_RESULT_OK)
        result = exchange_check_connected(client);
    if (result == PERCUSS_RESULT_OK)
        result = enter(client, request->sequence, waited, pending);
    if (result != PERCUSS_RESULT_OK)
        return result;
    (*pending)->gather = gather;
    return write_request(client, &wire, *pending);
}

/* Tells the server that no call waits for a request any more. */
static void withdraw(struct percuss_client *client, const struct pending *pending)
{
    percuss_v1_Request wire = {.sequence = pending->sequence, .cancel = true};
    if (pending->ready || pending->orphaned || exchange_check_connected(client))
        return;
    memcpy(wire.client, client->id, sizeof wire.client);
    memcpy(wire.server, client->server.id, sizeof wire.server);
    dds_write(client->request_writer, &wire);
}

/* Whether a request that came to that end is given up for good: a number of the program's own may
 * be asked again, and finds the work done by then. */
static bool is_given_up(const struct percuss_request *request, enum percuss_result result)
{
    return result == PERCUSS_RESULT_CANCELLED ||
           (result == PERCUSS_RESULT_TIMEOUT && request->sequence == 0);
}

/* Hands over a ready reply and forgets the request. */
static enum percuss_result collect(struct percuss_client *client, struct pending *pending,
                                   struct percuss_reply *reply)
{
    enum percuss_result result = pending->result;
    *reply = pending->reply;
    pending->reply = (struct percuss_reply){0};
    pending_remove(&client->pending, pending);
    if (result != PERCUSS_RESULT_OK)
        error_set(result, "a reply");
    return result;
}

/* The histories to wait for besides the reply. */
struct histories {
    const struct gather *gather;
    size_t contacts;
};

static bool histories_are_complete(const struct percuss_client *client, const void *subject)
{
    (void)client;
    const struct histories *histories = subject;
    return gather_is_complete(histories->gather, histories->contacts);
}

/* Waits for the reply, and the histories if they are gathered. */
static enum percuss_result await_all(struct percuss_client *client, const struct pending *pending,
                                     double deadline)
{
    enum percuss_result result = exchange_await(client, pending, deadline);
    /* a refusal has no contacts */
    struct histories histories = {pending->gather, pending->reply.contact_count};
    if (result != PERCUSS_RESULT_OK || !pending->gather)
        return result;
    result = receive_until(client, histories_are_complete, &histories, deadline);
    if (result == PERCUSS_RESULT_TIMEOUT)
        error_set(result, "the histories of request %llu have not all come from %s",
                  (unsigned long long)pending->sequence, client->server_name);
    return result;
}

/* Asks the successor of a server that has gone, under the same number: an impact that was answered
 * and stored is not done again. False: nothing has changed. */
static bool ask_successor(struct percuss_client *client, const struct percuss_request *request,
                          struct pending *pending, double deadline, enum percuss_result *result)
{
    struct request_storage storage;
    percuss_v1_Request wire;
    /* the histories of two servers are not mixed */
    if (pending->gather || !succession_follow(client, deadline))
        return false;
    *result = convert_request(request, &storage, &wire);
    if (*result == PERCUSS_RESULT_OK)
        *result = write_request(client, &wire, pending);
    return true;
}

enum percuss_result exchange_solve(struct percuss_client *client,
                                   const struct percuss_request *request, double deadline,
                                   struct gather *gather, struct percuss_reply *reply)
{
    struct pending *pending;
    pthread_mutex_lock(&client->lock);
    /* one that was lost while no call waited may have a successor */
    if (client->connected && client->lost)
        succession_follow(client, deadline);
    enum percuss_result result = send_request(client, request, true, gather, &pending);
    if (result != PERCUSS_RESULT_OK)
        goto unsent;
    /* of the server, or of the process that has taken its place */
    result = await_all(client, pending, deadline);
    while (result == PERCUSS_RESULT_NO_SERVER &&
           ask_successor(client, request, pending, deadline, &result)) {
        if (result != PERCUSS_RESULT_OK)
            goto unsent;
        result = await_all(client, pending, deadline);
    }
    /* handed over, or given up: nothing stays behind */
    if (result == PERCUSS_RESULT_OK) {
        result = collect(client, pending, reply);
    } else {
        if (is_given_up(request, result))
            withdraw(client, pending);
        pending_remove(&client->pending, pending);
    }
unsent:
    pthread_mutex_unlock(&client->lock);
    return result;
}

enum percuss_result exchange_ask(struct percuss_client *client,
                                 const struct percuss_request *request, double timeout,
                                 struct percuss_reply *reply)
{
    double deadline;
    *reply = (struct percuss_reply){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    return result == PERCUSS_RESULT_OK ? exchange_solve(client, request, deadline, NULL, reply)
                                       : result;
}

enum percuss_result exchange_submit(struct percuss_client *client,
                                    const struct percuss_request *request, uint64_t *sequence)
{
    struct pending *pending;
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = send_request(client, request, false, NULL, &pending);
    if (result == PERCUSS_RESULT_OK && sequence)
        *sequence = pending->sequence;
    pthread_mutex_unlock(&client->lock);
    return result;
}

/* The outstanding request of that sequence that no other thread waits for. */
static enum percuss_result exchange_find(struct percuss_client *client, uint64_t sequence,
                                         struct pending **pending)
{
    *pending = pending_find(&client->pending, sequence);
    if (*pending && !(*pending)->waited)
        return PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_UNKNOWN_SEQUENCE, "sequence: %llu: %s",
                     (unsigned long long)sequence,
                     *pending ? "another thread waits for it" : "no such request is outstanding");
}

static enum percuss_result wait_for(struct percuss_client *client, uint64_t sequence,
                                    double deadline, struct percuss_reply *reply)
{
    struct pending *pending;
    enum percuss_result result = exchange_find(client, sequence, &pending);
    if (result != PERCUSS_RESULT_OK)
        return result;
    pending->waited = true;
    result = exchange_await(client, pending, deadline);
    pending->waited = false;
    return result == PERCUSS_RESULT_OK ? collect(client, pending, reply) : result;
}

static bool any_is_settled(const struct percuss_client *client, const void *subject)
{
    (void)subject;
    return pending_first_ready(&client->pending) || !pending_has_unwaited(&client->pending) ||
           pending_first_orphan(&client->pending);
}

static enum percuss_result wait_for_any(struct percuss_client *client, double deadline,
                                        struct percuss_reply *reply)
{
    enum percuss_result result = receive_until(client, any_is_settled, NULL, deadline);
    if (result == PERCUSS_RESULT_TIMEOUT)
        return error_set(result, "none of %u outstanding requests is answered yet",
                         client->pending.count);
    if (result != PERCUSS_RESULT_OK)
        return result;
    struct pending *pending = pending_first_ready(&client->pending);
    const struct pending *orphan = pending_first_orphan(&client->pending);
    if (!pending && orphan)
        return refuse_orphan(client, orphan);
    if (!pending)
        return error_set(PERCUSS_RESULT_UNKNOWN_SEQUENCE, "no request is outstanding");
    return collect(client, pending, reply);
}

enum percuss_result exchange_wait(struct percuss_client *client, uint64_t sequence, double timeout,
                                  struct percuss_reply *reply)
{
    double deadline;
    *reply = (struct percuss_reply){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    pthread_mutex_lock(&client->lock);
    result = sequence ? wait_for(client, sequence, deadline, reply)
                      : wait_for_any(client, deadline, reply);
    pthread_mutex_unlock(&client->lock);
    return result;
}

enum percuss_result exchange_poll(struct percuss_client *client, uint64_t sequence,
                                  struct percuss_reply *reply)
{
    enum percuss_result result = exchange_wait(client, sequence, 0.0, reply);
    return result == PERCUSS_RESULT_TIMEOUT ? PERCUSS_RESULT_PENDING : result;
}

enum percuss_result exchange_cancel(struct percuss_client *client, uint64_t sequence)
{
    struct pending *pending;
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = exchange_find(client, sequence, &pending);
    if (result == PERCUSS_RESULT_OK) {
        withdraw(client, pending);
        pending_remove(&client->pending, pending);
    }
    pthread_mutex_unlock(&client->lock);
    return result;
}
