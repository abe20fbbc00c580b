/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdlib.h>
#include <string.h>

#include "announcements.h"
#include "error.h"
#include "receive.h"

static void convert_server(const percuss_v2_ServerStatus *wire, struct percuss_server *server)
{
    *server = (struct percuss_server){
        .process = wire->process,
        .workers = wire->workers,
        .bodies = wire->bodies,
        .queue_length = wire->queue_length,
        .queue_capacity = wire->queue_capacity,
        .answered = wire->answered,
        .refused = wire->refused,
        .uptime = wire->uptime,
        .progress = wire->progress,
        .specimens = wire->specimens,
    };
    memcpy(server->server, wire->server, sizeof server->server);
    memcpy(server->version, wire->version, sizeof server->version);
    memcpy(server->catalogue_revision, wire->catalogue_revision, sizeof server->catalogue_revision);
    memcpy(server->catalogue, wire->catalogue, sizeof server->catalogue);
    memcpy(server->host, wire->host, sizeof server->host);
    memcpy(server->state, wire->state, sizeof server->state);
    memcpy(server->activity, wire->activity, sizeof server->activity);
}

/* One look at the servers. PENDING: the one that is wanted (NULL: any) is not among them. */
static enum percuss_result look_at_servers(struct percuss_client *client, dds_entity_t reader,
                                           const uint8_t *wanted, struct percuss_server_list *list)
{
    struct announcements all;
    enum percuss_result result = announcements_read(client, reader, &all);
    if (result != PERCUSS_RESULT_OK)
        return result;
    bool found = false;
    list->count = 0;
    list->servers = calloc((size_t)all.count + 1, sizeof *list->servers);
    for (int i = 0; list->servers && i < all.count; ++i) {
        if (!all.infos[i].valid_data)
            continue;
        struct percuss_server *server = &list->servers[list->count++];
        convert_server(all.samples[i], server);
        found = found || !wanted || memcmp(server->server, wanted, 16) == 0;
    }
    announcements_release(&all);
    if (!list->servers)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a list of servers");
    if (!found)
        percuss_server_list_free(list);
    return found ? PERCUSS_RESULT_OK : PERCUSS_RESULT_PENDING;
}

enum percuss_result percuss_servers(struct percuss_client *client, double timeout,
                                    struct percuss_server_list *list)
{
    uint8_t server[16];
    double deadline;
    *list = (struct percuss_server_list){0};
    enum percuss_result result = receive_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = announcements_open(client, &client->server_reader, &percuss_v2_ServerStatus_desc,
                                    WIRE_TOPIC_SERVER_STATUS);
    if (result != PERCUSS_RESULT_OK)
        return result;
    const uint8_t *wanted = announcements_server(client, server) ? server : NULL;
    while ((result = look_at_servers(client, client->server_reader, wanted, list)) ==
           PERCUSS_RESULT_PENDING) {
        if (receive_now() >= deadline)
            return error_set(wanted ? PERCUSS_RESULT_TIMEOUT : PERCUSS_RESULT_NO_SERVER,
                             "no percussd has announced itself in DDS domain %u", client->domain);
        dds_sleepfor(ANNOUNCEMENTS_INTERVAL);
    }
    return result;
}

enum percuss_result announcements_connected(struct percuss_client *client, double timeout,
                                            struct percuss_server *server)
{
    struct percuss_server_list servers;
    uint8_t id[16];
    if (!announcements_server(client, id))
        return error_set(PERCUSS_RESULT_NO_SERVER, "not connected");
    enum percuss_result result = percuss_servers(client, timeout, &servers);
    for (size_t i = 0; i < servers.count; ++i)
        if (memcmp(servers.servers[i].server, id, sizeof id) == 0)
            *server = servers.servers[i];
    percuss_server_list_free(&servers);
    return result;
}

void percuss_server_list_free(struct percuss_server_list *list)
{
    if (!list)
        return;
    free(list->servers);
    *list = (struct percuss_server_list){0};
}
