/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "receive.h"

#include <math.h>
#include <string.h>

#include "batch.h"
#include "convert.h"
#include "ensemble_exchange.h"
#include "failure.h"
#include "gather.h"
#include "matched.h"
#include "moment.h"
#include "ping.h"

/* s from the discovery of a writer of replies until it would have answered a ping */
static const double NEWCOMER = 0.2;
static const double CLOCK_INTERVAL = 1.0; /* s between looks at the time of day */
static const double LONGEST_WAIT = 1e6;   /* s; so that infinity fits nanoseconds and a timespec */

/* Whether a reply comes from the server that we stay with; the lock is held. */
static bool is_ours(const struct percuss_client *client, const uint8_t server[16])
{
    return memcmp(client->server.id, server, sizeof client->server.id) == 0;
}

/* Stays with the process that has taken the place of the server: it answers under the same id,
 * which only one process at a time has, so that the former one has gone whether DDS knows it yet or
 * not. The lock is held. */
static void follow_successor(struct percuss_client *client, const struct client_server *server)
{
    client->server = *server;
    matched_participant(dds_get_matched_publication_data, client->reply_reader, server->writer,
                        &client->server.participant);
    /* where it runs is not known yet */
    char *place = strstr(client->server_name, " (");
    if (place)
        *place = '\0';
    client->lost = false;
    client->successions++;
    pending_orphan(&client->pending);
    receive_note_loss(client);
}

/* The answer to a ping, from any server while we are looking for one; the lock is held. */
static void file_ping(struct percuss_client *client, const struct client_server *server)
{
    size_t i = 0;
    if (client->connected && is_ours(client, server->id) && server->writer != client->server.writer)
        follow_successor(client, server);
    client->pings_answered += client->connected && is_ours(client, server->id);
    while (i < client->answering_count && memcmp(client->answering[i].id, server->id, 16) != 0)
        i++;
    if (i == CLIENT_MOST_SERVERS)
        return;
    client->answering[i] = *server;
    client->answering_count += i == client->answering_count;
}

/* Files one reply of that writer. A reply that is not waited for is a repeated or a cancelled one.
 */
static void file_reply(struct percuss_client *client, struct percuss_reply *reply,
                       dds_instance_handle_t writer, enum percuss_result result)
{
    pthread_mutex_lock(&client->lock);
    struct pending *pending = pending_find(&client->pending, reply->sequence);
    /* not by the server that it names: a durable reply may be older than its sender */
    bool ours = writer == client->server.writer;
    if (ours && pending && !pending->ready && !pending->batch && !pending->ensemble) {
        pending->reply = *reply;
        *reply = (struct percuss_reply){0};
        pending_set_ready(&client->pending, pending, result);
    }
    pthread_mutex_unlock(&client->lock);
    percuss_reply_free(reply);
}

static void take_reply(struct percuss_client *client, const percuss_v1_Reply *wire,
                       dds_instance_handle_t writer)
{
    struct percuss_reply reply;
    if (wire->sequence == 0) {
        struct client_server server = {.writer = writer};
        memcpy(server.id, wire->server, sizeof server.id);
        pthread_mutex_lock(&client->lock);
        file_ping(client, &server);
        pthread_mutex_unlock(&client->lock);
        return;
    }
    enum percuss_result result = convert_reply(wire, &reply);
    reply.sequence = wire->sequence;
    file_reply(client, &reply, writer, result);
}

static void take_batch_reply(struct percuss_client *client, const void *sample)
{
    const percuss_v1_BatchReply *wire = sample;
    pthread_mutex_lock(&client->lock);
    struct pending *pending = pending_find(&client->pending, wire->sequence);
    if (is_ours(client, wire->server) && pending && !pending->ready && pending->batch) {
        enum percuss_result result = batch_add_part(pending->batch, wire);
        if (result != PERCUSS_RESULT_PENDING)
            pending_set_ready(&client->pending, pending, result);
    }
    pthread_mutex_unlock(&client->lock);
}

/* The ensemble that waits under that sequence; the lock is held. NULL: none. */
static struct pending *find_ensemble(struct percuss_client *client, uint64_t sequence)
{
    struct pending *pending = pending_find(&client->pending, sequence);
    return pending && pending->ensemble ? pending : NULL;
}

static void take_ensemble_reply(struct percuss_client *client, const void *sample)
{
    const percuss_v1_EnsembleReply *wire = sample;
    pthread_mutex_lock(&client->lock);
    struct pending *pending = find_ensemble(client, wire->sequence);
    if (is_ours(client, wire->server) && pending && !pending->ready)
        pending_set_ready(&client->pending, pending,
                          convert_ensemble_reply(wire, &pending->ensemble->reply));
    pthread_mutex_unlock(&client->lock);
}

static void take_progress(struct percuss_client *client, const void *sample)
{
    const percuss_v1_EnsembleProgress *wire = sample;
    pthread_mutex_lock(&client->lock);
    struct pending *pending = find_ensemble(client, wire->sequence);
    if (pending)
        ensemble_exchange_note(pending->ensemble, wire);
    pthread_mutex_unlock(&client->lock);
}

static void take_samples(struct percuss_client *client, const void *sample)
{
    const percuss_v1_EnsembleSamples *wire = sample;
    pthread_mutex_lock(&client->lock);
    struct pending *pending = find_ensemble(client, wire->sequence);
    if (pending)
        ensemble_exchange_add(pending->ensemble, wire);
    pthread_mutex_unlock(&client->lock);
}

static bool take_replies(struct percuss_client *client, dds_entity_t reader, dds_return_t *count)
{
    void *samples[CLIENT_TAKE_AT_ONCE];
    dds_sample_info_t infos[CLIENT_TAKE_AT_ONCE];
    for (int i = 0; i < CLIENT_TAKE_AT_ONCE; i++)
        samples[i] = &client->taken[i];
    *count = dds_take(reader, samples, infos, CLIENT_TAKE_AT_ONCE, CLIENT_TAKE_AT_ONCE);
    for (dds_return_t i = 0; i < *count; i++)
        if (infos[i].valid_data)
            take_reply(client, &client->taken[i], infos[i].publication_handle);
    return *count == CLIENT_TAKE_AT_ONCE;
}

/* Whether a writer is not of the server that we stay with: one that does not know `server` in
 * requests answers those to others too, and not all its samples name their client. The server of a
 * writer that has gone is unknown: the server's last samples count. */
static bool is_of_another(struct percuss_client *client, dds_entity_t reader,
                          dds_instance_handle_t writer)
{
    dds_guid_t from;
    if (!matched_participant(dds_get_matched_publication_data, reader, writer, &from))
        return false;
    pthread_mutex_lock(&client->lock);
    bool another = memcmp(&from, &client->server.participant, sizeof from) != 0;
    pthread_mutex_unlock(&client->lock);
    return another;
}

/* Takes one sample, lent by the reader, and files it. */
static bool take_one(struct percuss_client *client, dds_entity_t reader, dds_return_t *count,
                     void (*file)(struct percuss_client *, const void *))
{
    void *sample[1] = {NULL};
    dds_sample_info_t info;
    *count = dds_take(reader, sample, &info, 1, 1);
    if (*count == 1 && info.valid_data && !is_of_another(client, reader, info.publication_handle))
        file(client, sample[0]);
    if (*count == 1)
        dds_return_loan(reader, sample, 1);
    return *count == 1;
}

/* Files one part of a trace. */
static void take_trace(struct percuss_client *client, const void *sample)
{
    const percuss_v1_Trace *wire = sample;
    pthread_mutex_lock(&client->lock);
    struct pending *pending = pending_find(&client->pending, wire->sequence);
    if (pending && pending->gather)
        gather_add(pending->gather, wire);
    pthread_mutex_unlock(&client->lock);
}

static bool take_trace_part(struct percuss_client *client, dds_entity_t reader, dds_return_t *count)
{
    return take_one(client, reader, count, take_trace);
}

static bool take_batch_part(struct percuss_client *client, dds_entity_t reader, dds_return_t *count)
{
    return take_one(client, reader, count, take_batch_reply);
}

static bool take_ensemble_replies(struct percuss_client *client, dds_entity_t reader,
                                  dds_return_t *count)
{
    return take_one(client, reader, count, take_ensemble_reply);
}

static bool take_progresses(struct percuss_client *client, dds_entity_t reader, dds_return_t *count)
{
    return take_one(client, reader, count, take_progress);
}

static bool take_sample_parts(struct percuss_client *client, dds_entity_t reader,
                              dds_return_t *count)
{
    return take_one(client, reader, count, take_samples);
}

/* Takes everything that a reader holds; `take` takes some and tells whether more may be left. */
static enum percuss_result take_all(struct percuss_client *client, dds_entity_t reader,
                                    bool (*take)(struct percuss_client *, dds_entity_t,
                                                 dds_return_t *))
{
    dds_return_t count;
    while (take(client, reader, &count))
        continue;
    return count < 0 ? failure_dds("taking replies", count) : PERCUSS_RESULT_OK;
}

/* Whether that writer of replies is there. */
static bool is_there(const struct percuss_client *client, dds_instance_handle_t writer)
{
    dds_builtintopic_endpoint_t *found =
        dds_get_matched_publication_data(client->reply_reader, writer);
    if (found)
        dds_builtintopic_free_endpoint(found);
    return found;
}

static void note_loss(struct percuss_client *client, bool lost)
{
    if (lost && !client->lost)
        client->lost_since = moment_now();
    client->lost = lost;
}

void receive_note_loss(struct percuss_client *client)
{
    note_loss(client, !is_there(client, client->server.writer));
}

/* Threads of DDS wait by the time of day too: one that was set back has them oversleep. */
static void look_at_clock(struct percuss_client *client)
{
    const double now = moment_now();
    if (now - client->clock_looked < CLOCK_INTERVAL)
        return;
    client->clock_looked = now;
    if (wire_clock_is_back(wire_clock_step(&client->clock)))
        wire_clock_rouse(client->request_writer);
}

/* Waits up to `seconds` for anything and files it. The lock is released meanwhile. */
static enum percuss_result lead(struct percuss_client *client, double seconds)
{
    dds_instance_handle_t writer = client->server.writer;
    client->leading = true;
    pthread_mutex_unlock(&client->lock);

    enum percuss_result result = PERCUSS_RESULT_OK;
    look_at_clock(client);
    const struct arrival came = arrivals_await(&client->arrivals, fmin(seconds, CLOCK_INTERVAL));
    /* the readers of this moment: other threads have added theirs before they asked */
    pthread_mutex_lock(&client->lock);
    dds_entity_t batch_reader = client->batch_reader, trace_reader = client->trace_reader;
    dds_entity_t ensemble_reader = client->ensemble_reader;
    pthread_mutex_unlock(&client->lock);
    /* before arrived samples are taken: those of a server arrive before its loss is seen */
    const bool gone = came.matched && !is_there(client, writer);
    if (came.any)
        result = take_all(client, client->reply_reader, take_replies);
    if (came.any && result == PERCUSS_RESULT_OK && batch_reader)
        result = take_all(client, batch_reader, take_batch_part);
    if (came.any && result == PERCUSS_RESULT_OK && trace_reader)
        result = take_all(client, trace_reader, take_trace_part);
    if (came.any && result == PERCUSS_RESULT_OK && ensemble_reader) {
        result = take_all(client, client->samples_reader, take_sample_parts);
        if (result == PERCUSS_RESULT_OK)
            result = take_all(client, client->progress_reader, take_progresses);
        if (result == PERCUSS_RESULT_OK)
            result = take_all(client, ensemble_reader, take_ensemble_replies);
    }
    if (result != PERCUSS_RESULT_OK)
        arrivals_again(&client->arrivals);

    pthread_mutex_lock(&client->lock);
    if (came.newcomer)
        client->newcomer_until = moment_now() + NEWCOMER;
    /* another server may have been chosen meanwhile */
    note_loss(client, client->lost || (gone && writer == client->server.writer));
    client->leading = false;
    pthread_cond_broadcast(&client->changed);
    return result;
}

/* Sleeps until the leader has filed something or resigns. */
static void follow(struct percuss_client *client, double deadline)
{
    double until = fmin(deadline, moment_now() + LONGEST_WAIT);
    struct timespec time = {.tv_sec = (time_t)until};
    time.tv_nsec = (long)(1e9 * (until - (double)time.tv_sec));
    pthread_cond_timedwait(&client->changed, &client->lock, &time);
}

/* Whether the server that was asked when there had been so many `successions` is not there any
 * more. */
static bool is_without_server(const struct percuss_client *client, uint64_t successions)
{
    return client->connected && (client->lost || client->successions != successions);
}

/* Pings a newcomer, which may be the server's successor, and waits up to `seconds` for anything. */
static enum percuss_result ask_newcomer(struct percuss_client *client, double seconds)
{
    enum percuss_result result = ping_write(client, client->server.id);
    return result ? result : lead(client, fmax(fmin(seconds, PING_INTERVAL), 0.0));
}

bool receive_is_watched_on(struct percuss_client *client, const struct watching *watching,
                           double *next)
{
    if (moment_now() < *next)
        return true;
    pthread_mutex_unlock(&client->lock);
    bool goes_on = watching_asks(watching, next);
    pthread_mutex_lock(&client->lock);
    return goes_on;
}

static enum percuss_result receive(struct percuss_client *client, receive_condition *done,
                                   const void *subject, double deadline, bool regardless)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    const uint64_t successions = client->successions;
    const struct watching watching = client->watching;
    double ask = watching_first(&watching);
    bool looked = false;
    while (result == PERCUSS_RESULT_OK && !done(client, subject)) {
        const double now = moment_now(), left = deadline - now, until = fmin(deadline, ask);
        if (!regardless && is_without_server(client, successions))
            return failure_lost(client->server_name);
        if (left <= 0.0 && looked)
            return PERCUSS_RESULT_TIMEOUT;
        looked = true;
        if (isfinite(ask) && now >= ask)
            result = receive_is_watched_on(client, &watching, &ask) ? result : watching_cancelled();
        else if (client->leading)
            follow(client, until);
        else if (client->connected && now < client->newcomer_until)
            result = ask_newcomer(client, until - now);
        else
            result = lead(client, fmax(until - now, 0.0));
    }
    return result;
}

enum percuss_result receive_until(struct percuss_client *client, receive_condition *done,
                                  const void *subject, double deadline)
{
    return receive(client, done, subject, deadline, false);
}

enum percuss_result receive_regardless(struct percuss_client *client, receive_condition *done,
                                       const void *subject, double deadline)
{
    return receive(client, done, subject, deadline, true);
}
