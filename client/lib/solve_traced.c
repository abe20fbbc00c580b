/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A question with its time histories. */

#include <stdlib.h>

#include "connect.h"
#include "error.h"
#include "exchange.h"
#include "failure.h"
#include "gather.h"
#include "library.h"
#include "moment.h"
#include "receive.h"

/* The reader of traces is made when first needed, and must be known to the server before the
 * question is. */
static enum percuss_result connect_traces(struct percuss_client *client, double deadline)
{
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = exchange_check_connected(client);
    if (result == PERCUSS_RESULT_OK && !client->trace_reader) {
        dds_entity_t reader =
            client_reply_reader_create(client, &percuss_v1_Trace_desc, WIRE_TOPIC_TRACE);
        if (reader < 0)
            result = failure_dds("reader of " WIRE_TOPIC_TRACE, reader);
        else
            client->trace_reader = reader;
    }
    dds_entity_t reader = client->trace_reader;
    pthread_mutex_unlock(&client->lock);
    if (result == PERCUSS_RESULT_OK)
        result = connect_match(client, client->request_writer, reader, deadline);
    return result;
}

enum percuss_result solve_traced(struct percuss_client *client,
                                 const struct percuss_request *request, double timeout,
                                 struct percuss_reply *reply, struct percuss_trace *trace)
{
    double deadline;
    *reply = (struct percuss_reply){0};
    *trace = (struct percuss_trace){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = connect_traces(client, deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* histories come in parts beside the reply */
    struct gather *gather = calloc(1, sizeof *gather);
    if (!gather)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a trace");
    result = exchange_solve(client, request, deadline, gather, reply);
    if (result == PERCUSS_RESULT_OK)
        result = gather_collect(gather, reply->contact_count, trace);
    /* both or none */
    if (result != PERCUSS_RESULT_OK)
        percuss_reply_free(reply);
    gather_clear(gather);
    free(gather);
    return result;
}
