/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "succession.h"

#include <math.h>
#include <string.h>

#include "moment.h"
#include "ping.h"
#include "receive.h"

/* s from the loss of a server that ended in good order until another process has had time to take
 * its place, which takes a quarter of it where the machine has time */
static const double SUCCESSION = 0.4;
/* s after the loss of one that did not: it has been gone for a lease by then, and who took its
 * place is there and needs no more than to answer a ping */
static const double ANSWER = 0.2;

/* Whether the last word of the server was that it ends. */
static bool was_draining(const struct percuss_client *client)
{
    percuss_v1_ServerStatus status = {0};
    void *samples[1] = {&status};
    dds_sample_info_t info;
    memcpy(status.server, client->server.id, sizeof status.server);
    dds_instance_handle_t server = dds_lookup_instance(client->server_reader, &status);
    /* what it announced stays readable when it has gone */
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

bool succession_follow(struct percuss_client *client, double deadline)
{
    const double patience = was_draining(client) ? SUCCESSION : ANSWER;
    const double end = fmin(deadline, client->lost_since + patience);
    enum percuss_result result = PERCUSS_RESULT_OK;
    /* whoever takes the place answers what names the server */
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
