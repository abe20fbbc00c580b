/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ping.h"

#include <string.h>

#include "failure.h"

enum percuss_result ping_write(struct percuss_client *client, const uint8_t *server)
{
    percuss_v1_Request ping = {0};
    memcpy(ping.client, client->id, sizeof ping.client);
    if (server)
        memcpy(ping.server, server, sizeof ping.server);
    dds_return_t code = dds_write(client->request_writer, &ping);
    return code < 0 && code != DDS_RETCODE_TIMEOUT ? failure_dds("writing a ping", code)
                                                   : PERCUSS_RESULT_OK;
}
