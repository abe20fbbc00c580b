/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "service.h"

#include <stdio.h>
#include <string.h>

enum { MOST_CLIENTS = 256, TRIES = 100 };
static const char CLIENT[] = "clientid=";

void service_name(dds_entity_t participant, dds_qos_t *qos)
{
    dds_guid_t guid = {{0}};
    char text[64] = "serviceid=";
    size_t length = strlen(text);
    dds_get_guid(participant, &guid);
    for (size_t i = 0; i < sizeof guid.v; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%02x", i ? "." : "",
                                   guid.v[i]);
    text[length++] = ';';
    dds_qset_userdata(qos, text, length);
}

bool service_client_id(const void *data, size_t size, char id[SERVICE_ID_SIZE])
{
    id[0] = '\0';
    const char *start = size ? memmem(data, size, CLIENT, strlen(CLIENT)) : NULL;
    if (!start)
        return false;
    start += strlen(CLIENT);
    const char *end = memchr(start, ';', size - (size_t)(start - (const char *)data));
    if (end && (size_t)(end - start) < SERVICE_ID_SIZE) {
        memcpy(id, start, (size_t)(end - start));
        id[end - start] = '\0';
    }
    return id[0] != '\0';
}

/* That of an endpoint's user data. */
static bool endpoint_id(const dds_builtintopic_endpoint_t *endpoint, char id[SERVICE_ID_SIZE])
{
    void *data = NULL;
    size_t size = 0;
    bool has = endpoint && dds_qget_userdata(endpoint->qos, &data, &size) && data &&
               service_client_id(data, size, id);
    dds_free(data);
    return has;
}

static bool is_matched(dds_entity_t replies, const char *wanted)
{
    dds_instance_handle_t readers[MOST_CLIENTS];
    dds_return_t count = dds_get_matched_subscriptions(replies, readers, MOST_CLIENTS);
    bool found = false;
    for (dds_return_t i = 0; i < count && i < MOST_CLIENTS && !found; i++) {
        char id[SERVICE_ID_SIZE];
        dds_builtintopic_endpoint_t *reader =
            dds_get_matched_subscription_data(replies, readers[i]);
        found = endpoint_id(reader, id) && strcmp(id, wanted) == 0;
        if (reader)
            dds_builtintopic_free_endpoint(reader);
    }
    return found;
}

void service_await(dds_entity_t requests, dds_entity_t replies, dds_instance_handle_t client)
{
    char id[SERVICE_ID_SIZE];
    dds_builtintopic_endpoint_t *writer = dds_get_matched_publication_data(requests, client);
    bool known = endpoint_id(writer, id);
    if (writer)
        dds_builtintopic_free_endpoint(writer);
    for (int i = 0; known && i < TRIES && !is_matched(replies, id); i++)
        dds_sleepfor(DDS_MSECS(1));
}
