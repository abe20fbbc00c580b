/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "succession.h"

#include <math.h>
#include <string.h>

#include "error.h"
#include "receive.h"

/* s from the loss of a server until another process has had time to take its place, which takes a
 * tenth of it where the machine has time; and between two pings */
static const double SUCCESSION = 1.0, PING_INTERVAL = 5e-3;

enum percuss_result succession_ping(struct percuss_client *client, const uint8_t *server)
{
    percuss_v1_Request ping = {0};
    memcpy(ping.client, client->id, sizeof ping.client);
    if (server)
        memcpy(ping.server, server, sizeof ping.server);
    dds_return_t code = dds_write(client->request_writer, &ping);
    return code < 0 && code != DDS_RETCODE_TIMEOUT ? error_dds("writing a ping", code)
                                                   : PERCUSS_RESULT_OK;
}

static bool is_followed(const struct percuss_client *client, const void *subject)
{
    (void)subject;
    return !client->lost;
}

bool succession_follow(struct percuss_client *client, double deadline)
{
    const double end = fmin(deadline, client->lost_since + SUCCESSION);
    enum percuss_result result = PERCUSS_RESULT_OK;
    /* whoever takes the place answers what names the server */
    while (client->lost && result == PERCUSS_RESULT_OK && receive_now() < end) {
        result = succession_ping(client, client->server.id);
        if (result == PERCUSS_RESULT_OK)
            result = receive_regardless(client, is_followed, NULL,
                                        fmin(end, receive_now() + PING_INTERVAL));
        if (result == PERCUSS_RESULT_TIMEOUT)
            result = PERCUSS_RESULT_OK;
    }
    return client->connected && !client->lost;
}
