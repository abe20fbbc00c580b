/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "service.h"

#include <stdio.h>
#include <string.h>

enum { MOST_CLIENTS = 256, TRIES = 1000 };
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

/* Whether a reader and a writer are of the same peer. */
typedef bool same_peer(const dds_builtintopic_endpoint_t *reader,
                       const dds_builtintopic_endpoint_t *writer);

static bool has_same_id(const dds_builtintopic_endpoint_t *reader,
                        const dds_builtintopic_endpoint_t *writer)
{
    char id[SERVICE_ID_SIZE], wanted[SERVICE_ID_SIZE];
    return endpoint_id(reader, id) && endpoint_id(writer, wanted) && strcmp(id, wanted) == 0;
}

static bool has_same_participant(const dds_builtintopic_endpoint_t *reader,
                                 const dds_builtintopic_endpoint_t *writer)
{
    return memcmp(&reader->participant_key, &writer->participant_key,
                  sizeof reader->participant_key) == 0;
}

static bool is_matched(dds_entity_t replies, const dds_builtintopic_endpoint_t *writer,
                       same_peer *same)
{
    dds_instance_handle_t readers[MOST_CLIENTS];
    dds_return_t count = dds_get_matched_subscriptions(replies, readers, MOST_CLIENTS);
    bool found = false;
    for (dds_return_t i = 0; i < count && i < MOST_CLIENTS && !found; i++) {
        dds_builtintopic_endpoint_t *reader =
            dds_get_matched_subscription_data(replies, readers[i]);
        found = reader && same(reader, writer);
        if (reader)
            dds_builtintopic_free_endpoint(reader);
    }
    return found;
}

bool service_await(dds_entity_t requests, dds_entity_t replies, dds_instance_handle_t client)
{
    char id[SERVICE_ID_SIZE];
    dds_builtintopic_endpoint_t *writer = dds_get_matched_publication_data(requests, client);
    same_peer *same = endpoint_id(writer, id) ? has_same_id : has_same_participant;
    bool found = false;
    for (int i = 0; writer && !found && i < TRIES; i++) {
        found = is_matched(replies, writer, same);
        if (!found)
            dds_sleepfor(DDS_MSECS(1));
    }
    if (writer)
        dds_builtintopic_free_endpoint(writer);
    return found;
}
