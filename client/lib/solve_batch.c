/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many questions in one sample. */

#include <stdlib.h>
#include <string.h>

#include "batch.h"
#include "connect.h"
#include "convert.h"
#include "error.h"
#include "exchange.h"
#include "failure.h"
#include "library.h"
#include "moment.h"
#include "receive.h"

/* The wire form of a batch. */
struct batch_sample {
    percuss_v1_Request requests[PERCUSS_MAX_BATCH];
    struct request_storage storage[PERCUSS_MAX_BATCH];
};

/* Endpoints of batches are made at the first one; most clients never need them. Lock is held. */
static enum percuss_result open_endpoints(struct percuss_client *client)
{
    if (client->batch_reader)
        return PERCUSS_RESULT_OK;
    if (client->batch_writer <= 0)
        client->batch_writer =
            client_writer_create(client, &percuss_v1_BatchRequest_desc, WIRE_TOPIC_BATCH_REQUEST);
    if (client->batch_writer < 0)
        return failure_dds("writer of " WIRE_TOPIC_BATCH_REQUEST, client->batch_writer);
    dds_entity_t reader =
        client_reply_reader_create(client, &percuss_v1_BatchReply_desc, WIRE_TOPIC_BATCH_REPLY);
    if (reader < 0)
        return failure_dds("reader of " WIRE_TOPIC_BATCH_REPLY, reader);
    client->batch_reader = reader;
    return PERCUSS_RESULT_OK;
}

static enum percuss_result connect_batch(struct percuss_client *client, double deadline)
{
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = exchange_check_connected(client);
    if (result == PERCUSS_RESULT_OK)
        result = open_endpoints(client);
    dds_entity_t writer = client->batch_writer, reader = client->batch_reader;
    pthread_mutex_unlock(&client->lock);
    return result == PERCUSS_RESULT_OK ? connect_match(client, writer, reader, deadline) : result;
}

static enum percuss_result convert_batch(const struct percuss_request *requests, size_t count,
                                         struct batch_sample *sample)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    for (size_t i = 0; i < count && result == PERCUSS_RESULT_OK; i++)
        result = convert_request(&requests[i], &sample->storage[i], &sample->requests[i]);
    return result;
}

/* Enters and writes the batch. The questions' own sequences are drawn as well, so that no server
 * takes one for a repeated request. The lock is held. */
static enum percuss_result send_batch(struct percuss_client *client, struct batch_sample *sample,
                                      size_t count, struct pending **pending)
{
    /* one number for the batch and one for each question */
    uint64_t sequence = client_draw_sequences(client, count + 1);
    enum percuss_result result = pending_add(&client->pending, sequence, pending);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* ids of client and server */
    percuss_v1_BatchRequest wire = {.sequence = sequence};
    memcpy(wire.client, client->id, sizeof wire.client);
    memcpy(wire.server, client->server.id, sizeof wire.server);
    for (size_t i = 0; i < count; i++) {
        memcpy(sample->requests[i].client, client->id, sizeof client->id);
        sample->requests[i].sequence = sequence + 1 + i;
    }
    /* sent, or not waited for */
    wire.requests._buffer = sample->requests;
    wire.requests._length = wire.requests._maximum = (uint32_t)count;
    dds_return_t code = dds_write(client->batch_writer, &wire);
    if (code >= 0)
        return PERCUSS_RESULT_OK;
    pending_remove(&client->pending, *pending);
    return failure_dds("writing the batch", code);
}

/* Tells the server that no call waits for a batch any more: its number was drawn for it. */
static void withdraw_batch(struct percuss_client *client, const struct pending *pending)
{
    percuss_v1_BatchRequest wire = {.sequence = pending->sequence, .cancel = true};
    if (pending->ready || pending->orphaned || exchange_check_connected(client))
        return;
    memcpy(wire.client, client->id, sizeof wire.client);
    memcpy(wire.server, client->server.id, sizeof wire.server);
    dds_write(client->batch_writer, &wire);
}

/* Sends a converted batch and waits until `batch` is complete. */
static enum percuss_result exchange_batch(struct percuss_client *client,
                                          struct batch_sample *sample, size_t count,
                                          double deadline, struct batch *batch)
{
    struct pending *pending;
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = send_batch(client, sample, count, &pending);
    if (result == PERCUSS_RESULT_OK) {
        pending->waited = true;
        pending->batch = batch;
        result = exchange_await(client, pending, deadline);
        if (result == PERCUSS_RESULT_OK && pending->result != PERCUSS_RESULT_OK)
            result = error_set(pending->result, "a batch reply");
        if (result == PERCUSS_RESULT_CANCELLED || result == PERCUSS_RESULT_TIMEOUT)
            withdraw_batch(client, pending);
        pending_remove(&client->pending, pending);
    }
    pthread_mutex_unlock(&client->lock);
    return result;
}

enum percuss_result solve_batch(struct percuss_client *client,
                                const struct percuss_request *requests, size_t count,
                                double timeout, struct percuss_reply *replies)
{
    double deadline;
    struct batch batch = {0};
    if (count < 1 || count > PERCUSS_MAX_BATCH)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "count: %zu: 1..%d is allowed", count,
                         PERCUSS_MAX_BATCH);
    memset(replies, 0, count * sizeof *replies);
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = connect_batch(client, deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* the questions as one sample of DDS, which is too large for a stack */
    struct batch_sample *sample = malloc(sizeof *sample);
    if (!sample)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a batch of %zu requests", count);

    /* sent once; the answer comes in parts */
    result = convert_batch(requests, count, sample);
    if (result == PERCUSS_RESULT_OK)
        result = exchange_batch(client, sample, count, deadline, &batch);
    if (result == PERCUSS_RESULT_OK)
        batch_collect(&batch, replies, count);
    batch_clear(&batch);
    free(sample);
    return result;
}
