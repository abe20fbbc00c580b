/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <percuss/slow_link.h>

static enum percuss_result ask(void *context, const struct percuss_request *request,
                               struct percuss_reply *reply)
{
    struct percuss_slow_link *link = context;
    enum percuss_result result = PERCUSS_RESULT_OK;
    if (!link->connected)
        result = percuss_client_connect(link->client, link->reconnect);
    if (result == PERCUSS_RESULT_OK)
        result = percuss_solve(link->client, request, link->timeout, reply);
    link->connected = result == PERCUSS_RESULT_OK;
    return result;
}

static const char *problem(void *context)
{
    (void)context;
    return percuss_error_text();
}

struct percuss_slow_link percuss_slow_link_default(struct percuss_client *client)
{
    return (struct percuss_slow_link){.client = client, .timeout = 2.0, .reconnect = 0.1};
}

struct percuss_slow_service percuss_slow_link_service(struct percuss_slow_link *link)
{
    return (struct percuss_slow_service){
        .context = link, .solve = ask, .release = percuss_reply_free, .problem = problem};
}
