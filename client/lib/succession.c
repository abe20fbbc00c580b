/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "succession.h"

#include <math.h>

#include "moment.h"
#include "ping.h"
#include "receive.h"

/* s from the loss of a server until another process has had time to take its place, which takes a
 * quarter of it where the machine has time; a killed one has been gone for a lease by then */
static const double SUCCESSION = 0.4;

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
