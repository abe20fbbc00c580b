/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <percuss/slow_link.h>

#include "error.h"
#include "moment.h"

static const double BUSY_INTERVAL = 0.02; /* s until a busy server is asked again */

/* Sends the request and waits for its reply up to the deadline. NO_SERVER: the server has gone; the
 * request keeps its sequence, to be sent again to the next one. */
static enum percuss_result exchange(struct percuss_client *client, struct percuss_request *request,
                                    double deadline, struct percuss_reply *reply)
{
    enum percuss_result result = percuss_submit(client, request, &request->sequence);
    if (result != PERCUSS_RESULT_OK)
        return result;
    double left = fmax(0.0, deadline - moment_now());
    result = percuss_wait(client, request->sequence, left, reply);
    if (result != PERCUSS_RESULT_OK)
        percuss_cancel(client, request->sequence);
    return result;
}

/* A server that is busy, or is being restarted, costs time and does not change the result. */
static enum percuss_result ask(void *context, const struct percuss_request *question,
                               struct percuss_reply *reply)
{
    struct percuss_slow_link *link = context;
    if (ERROR_NULL(link, question, reply))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    struct percuss_request request = *question;
    enum percuss_result result;
    double deadline;
    if (moment_deadline(link->timeout, &deadline))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    for (;;) {
        /* to any server that is there now */
        result = link->connected ? PERCUSS_RESULT_OK
                                 : percuss_client_connect(link->client, link->reconnect);
        link->connected = result == PERCUSS_RESULT_OK;
        if (!link->connected)
            return result;
        result = exchange(link->client, &request, deadline, reply);
        /* once more while there is time, if it is busy or has gone */
        bool busy = result == PERCUSS_RESULT_OK && reply->status == PERCUSS_BUSY;
        link->connected = result == PERCUSS_RESULT_OK;
        if (moment_now() >= deadline || (!busy && result != PERCUSS_RESULT_NO_SERVER))
            return result;
        if (busy) {
            percuss_reply_free(reply);
            request.sequence = 0; /* the answer to this one is that the server is busy */
            moment_sleep(BUSY_INTERVAL);
        }
    }
}

static const char *problem(void *context)
{
    (void)context;
    return percuss_error_text();
}

struct percuss_slow_link percuss_slow_link_default(struct percuss_client *client)
{
    return (struct percuss_slow_link){.client = client, .timeout = 60.0, .reconnect = 10.0};
}

struct percuss_slow_service percuss_slow_link_service(struct percuss_slow_link *link)
{
    return (struct percuss_slow_service){
        .context = link, .solve = ask, .release = percuss_reply_free, .problem = problem};
}
