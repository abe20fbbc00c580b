/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble: one request, progress, perhaps a list of samples, and the reply. */

#include <stdlib.h>
#include <string.h>

#include "connect.h"
#include "convert.h"
#include "ensemble_exchange.h"
#include "error.h"
#include "exchange.h"
#include "failure.h"
#include "library.h"
#include "moment.h"
#include "receive.h"

/* Listed samples are written before the reply; they are waited for so long after it, s. */
static const double STRAGGLER_SECONDS = 3.0;

/* Endpoints of ensembles are made at the first one. The lock is held. */
static enum percuss_result open_endpoints(struct percuss_client *client)
{
    if (client->ensemble_reader)
        return PERCUSS_RESULT_OK;
    /* the reply's reader last: that it is there says that all are */
    const struct {
        dds_entity_t *entity;
        const dds_topic_descriptor_t *type;
        const char *topic;
    } readers[] = {
        {&client->samples_reader, &percuss_v1_EnsembleSamples_desc, WIRE_TOPIC_ENSEMBLE_SAMPLES},
        {&client->progress_reader, &percuss_v1_EnsembleProgress_desc, WIRE_TOPIC_ENSEMBLE_PROGRESS},
        {&client->ensemble_reader, &percuss_v1_EnsembleReply_desc, WIRE_TOPIC_ENSEMBLE_REPLY},
    };
    if (!client->ensemble_writer)
        client->ensemble_writer = client_writer_create(client, &percuss_v1_EnsembleRequest_desc,
                                                       WIRE_TOPIC_ENSEMBLE_REQUEST);
    /* a writer that cannot be made now is tried again at the next ensemble */
    if (client->ensemble_writer < 0) {
        dds_entity_t code = client->ensemble_writer;
        client->ensemble_writer = 0;
        return failure_dds("writer of " WIRE_TOPIC_ENSEMBLE_REQUEST, code);
    }
    for (size_t i = 0; i < sizeof readers / sizeof readers[0]; i++) {
        if (*readers[i].entity)
            continue;
        dds_entity_t reader = client_reply_reader_create(client, readers[i].type, readers[i].topic);
        if (reader < 0)
            return failure_dds(readers[i].topic, reader);
        *readers[i].entity = reader;
    }
    return PERCUSS_RESULT_OK;
}

/* Until requests, progress and replies are matched. */
static enum percuss_result connect_ensemble(struct percuss_client *client, double deadline)
{
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = exchange_check_connected(client);
    if (result == PERCUSS_RESULT_OK)
        result = open_endpoints(client);
    const dds_entity_t readers[] = {client->ensemble_reader, client->progress_reader,
                                    client->samples_reader};
    dds_entity_t writer = client->ensemble_writer;
    pthread_mutex_unlock(&client->lock);
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < sizeof readers / sizeof readers[0]; i++)
        result = connect_match(client, writer, readers[i], deadline);
    return result;
}

/* Enters and writes the request; the lock is held. */
static enum percuss_result send(struct percuss_client *client, percuss_v1_EnsembleRequest *wire,
                                struct pending **pending)
{
    uint64_t sequence = wire->sequence;
    /* a number of ours, or the program's unless it is outstanding */
    if (sequence == 0)
        sequence = client_draw_sequences(client, 1);
    else if (pending_find(&client->pending, sequence))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "sequence: %llu: is outstanding",
                         (unsigned long long)sequence);
    else if (sequence >= client->next_sequence)
        client->next_sequence = sequence + 1;
    enum percuss_result result = pending_add(&client->pending, sequence, pending);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* ids of client and server */
    memcpy(wire->client, client->id, sizeof wire->client);
    memcpy(wire->server, client->server.id, sizeof wire->server);
    wire->sequence = sequence;
    /* sent, or not waited for */
    dds_return_t code = dds_write(client->ensemble_writer, wire);
    if (code >= 0)
        return PERCUSS_RESULT_OK;
    pending_remove(&client->pending, *pending);
    return failure_dds("writing the ensemble", code);
}

static void send_cancel(struct percuss_client *client, uint64_t sequence)
{
    percuss_v1_EnsembleRequest wire = {.sequence = sequence, .cancel = true};
    memcpy(wire.client, client->id, sizeof wire.client);
    memcpy(wire.server, client->server.id, sizeof wire.server);
    dds_write(client->ensemble_writer, &wire);
}

/* The events that the waiting thread looks for. */
struct news {
    const struct pending *pending;
    unsigned heard;
};

static bool is_news(const struct percuss_client *client, const void *subject)
{
    (void)client;
    const struct news *news = subject;
    return news->pending->ready || news->pending->ensemble->heard != news->heard;
}

struct watcher {
    percuss_progress_function *function;
    void *context;
};

/* Tells the last progress by the reply: its sample may come after the reply, since DDS does not
 * order two topics. */
static void tell_last(struct percuss_client *client, const struct percuss_ensemble_reply *reply,
                      const struct watcher *watcher, uint64_t told)
{
    if (!watcher->function || reply->statistic_count == 0 || told == reply->samples)
        return;
    const struct percuss_statistic *restitution = &reply->statistics[0];
    const struct percuss_ensemble_progress progress = {
        .done = reply->samples,
        .samples = reply->requested,
        .mean = restitution->mean,
        .standard_deviation = restitution->standard_deviation,
        .half_width = restitution->mean_high - restitution->mean,
    };
    pthread_mutex_unlock(&client->lock);
    watcher->function(watcher->context, &progress);
    pthread_mutex_lock(&client->lock);
}

/* Waits for the reply, telling of progress. The lock is held but while the watcher is told. */
static enum percuss_result await(struct percuss_client *client, struct pending *pending,
                                 double timeout, const struct watcher *watcher)
{
    const struct watching watching = client->watching;
    double ask = watching_first(&watching);
    bool cancelled = false;
    unsigned told = 0;
    struct percuss_ensemble_progress progress = {0};
    while (!pending->ready) {
        /* the server may have gone while the watcher was told */
        if (pending->orphaned)
            return failure_lost(client->server_name);
        /* any sign of life begins the timeout again */
        struct news news = {pending, pending->ensemble->heard};
        double deadline = moment_now() + timeout;
        enum percuss_result result = receive_until(client, is_news, &news, deadline);
        if (result == PERCUSS_RESULT_TIMEOUT)
            return error_set(result, "no progress of ensemble %llu for %g s",
                             (unsigned long long)pending->sequence, timeout);
        if (result != PERCUSS_RESULT_OK)
            return result;
        /* progress may come more often than receive_until asks */
        if (!receive_is_watched_on(client, &watching, &ask))
            return watching_cancelled();
        /* only new progress is told, without the lock */
        if (!watcher->function || pending->ensemble->told == told)
            continue;
        told = pending->ensemble->told;
        progress = pending->ensemble->progress;
        pthread_mutex_unlock(&client->lock);
        bool go_on = watcher->function(watcher->context, &progress);
        pthread_mutex_lock(&client->lock);
        /* cancelled: the reply still comes, of the samples solved by then. One look at the answer:
         * a function in Python that ends by an exception leaves any byte in its place, of which two
         * looks could differ */
        if (!go_on && !cancelled) {
            send_cancel(client, pending->sequence);
            cancelled = true;
        }
    }
    if (pending->result == PERCUSS_RESULT_OK)
        tell_last(client, &pending->ensemble->reply, watcher, progress.done);
    return pending->result;
}

static bool samples_are_there(const struct percuss_client *client, const void *subject)
{
    (void)client;
    return ensemble_exchange_is_complete(subject);
}

static void hand_over_samples(struct ensemble_exchange *exchange)
{
    if (!ensemble_exchange_is_complete(exchange))
        return;
    exchange->reply.rows = exchange->rows;
    exchange->reply.column_count = exchange->columns;
    exchange->rows = NULL;
}

static enum percuss_result exchange_ensemble(struct percuss_client *client,
                                             percuss_v1_EnsembleRequest *wire, double timeout,
                                             const struct watcher *watcher,
                                             struct ensemble_exchange *exchange)
{
    struct pending *pending;
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = send(client, wire, &pending);
    if (result == PERCUSS_RESULT_OK) {
        pending->waited = true;
        pending->ensemble = exchange;
        result = await(client, pending, timeout, watcher);
        /* no call waits for the reply */
        if (result == PERCUSS_RESULT_CANCELLED)
            send_cancel(client, pending->sequence);
        /* samples have a topic of their own, and the last ones may be later than the reply */
        if (result == PERCUSS_RESULT_OK && wire->list_samples && exchange->reply.samples > 0)
            receive_until(client, samples_are_there, exchange, moment_now() + STRAGGLER_SECONDS);
        if (result == PERCUSS_RESULT_NO_MEMORY)
            error_set(result, "the reply to an ensemble");
        pending_remove(&client->pending, pending);
    }
    pthread_mutex_unlock(&client->lock);
    return result;
}

enum percuss_result solve_ensemble(struct percuss_client *client,
                                   const struct percuss_ensemble_request *request, double timeout,
                                   percuss_progress_function *progress, void *context,
                                   struct percuss_ensemble_reply *reply)
{
    double deadline;
    percuss_v1_EnsembleRequest wire;
    struct watcher watcher = {progress, context};
    struct ensemble_exchange exchange = {0};
    *reply = (struct percuss_ensemble_reply){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    /* the request as a sample of DDS */
    struct ensemble_storage *storage = malloc(sizeof *storage);
    if (result == PERCUSS_RESULT_OK && !storage)
        result = error_set(PERCUSS_RESULT_NO_MEMORY, "an ensemble");
    if (result == PERCUSS_RESULT_OK)
        result = convert_ensemble_request(request, storage, &wire);
    if (result == PERCUSS_RESULT_OK)
        result = connect_ensemble(client, deadline);
    /* asked, with all that arrives gathered in the exchange */
    if (result == PERCUSS_RESULT_OK) {
        wire.sequence = request->sequence;
        result = exchange_ensemble(client, &wire, timeout, &watcher, &exchange);
    }
    /* to the caller, or freed */
    if (result == PERCUSS_RESULT_OK) {
        hand_over_samples(&exchange);
        *reply = exchange.reply;
    } else {
        percuss_ensemble_reply_free(&exchange.reply);
    }
    free(exchange.rows);
    free(storage);
    return result;
}
