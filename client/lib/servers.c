/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "announcements.h"
#include "convert.h"
#include "error.h"
#include "exchange.h"
#include "failure.h"
#include "library.h"
#include "moment.h"
#include "receive.h"
#include "servers.h"

/* A server with what decides its place in the list. */
struct sighting {
    bool draining;
    double started; /* s, by the clock of its host */
    struct percuss_server server;
};

static int compare_sightings(const void *left, const void *right)
{
    const struct sighting *a = left, *b = right;
    if (a->draining != b->draining)
        return a->draining - b->draining;
    if (a->started != b->started)
        return a->started < b->started ? -1 : 1;
    return memcmp(a->server.server, b->server.server, sizeof a->server.server);
}

/* The valid ones among the samples; their number. False: no memory for all of them. */
static bool list_sightings(const struct announcements *all, struct sighting *sightings,
                           size_t *listed)
{
    size_t count = 0;
    bool good = true;
    for (int i = 0; i < all->count; i++) {
        if (!all->infos[i].valid_data)
            continue;
        struct sighting *sighting = &sightings[count++];
        good = convert_announced_server(all->samples[i], &sighting->server) && good;
        sighting->draining = strcmp(sighting->server.state, "ready") != 0;
        sighting->started = 1e-9 * (double)all->infos[i].source_timestamp - sighting->server.uptime;
    }
    qsort(sightings, count, sizeof *sightings, compare_sightings);
    *listed = count;
    return good;
}

void servers_describe(const uint8_t id[16], const struct percuss_server *server,
                      char text[SERVERS_NAME_SIZE])
{
    int length =
        snprintf(text, SERVERS_NAME_SIZE, "percussd %02x%02x%02x%02x", id[0], id[1], id[2], id[3]);
    if (server)
        snprintf(text + length, SERVERS_NAME_SIZE - (size_t)length, " (process %u on %s)",
                 server->process, server->host);
}

/* Names the server that we stay with once it has announced itself: when it has gone, nobody knows
 * any more where it was. */
static void note_name(struct percuss_client *client, const struct percuss_server_list *list)
{
    pthread_mutex_lock(&client->lock);
    const struct percuss_server *ours = servers_find(list, client->server.id);
    if (ours)
        servers_describe(client->server.id, ours, client->server_name);
    pthread_mutex_unlock(&client->lock);
}

/* Servers hear of each other, and say of how many. One of 0.1.0 says nothing. */
static size_t count_known(const struct announcements *all)
{
    size_t known = 0;
    for (int i = 0; i < all->count; i++) {
        const percuss_v1_ServerStatus *status = all->samples[i];
        if (all->infos[i].valid_data && known < 1 + (size_t)status->others)
            known = 1 + (size_t)status->others;
    }
    return known;
}

enum percuss_result servers_look(struct percuss_client *client, struct percuss_server_list *list,
                                 size_t *known)
{
    struct announcements all;
    *list = (struct percuss_server_list){0};
    if (known)
        *known = 0;
    enum percuss_result result = announcements_read(client, client->server_reader, &all);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* all that are announced, in the order in which they are preferred */
    struct sighting *sightings = calloc((size_t)all.count + 1, sizeof *sightings);
    list->servers = calloc((size_t)all.count + 1, sizeof *list->servers);
    bool good = sightings && list->servers;
    if (good)
        good = list_sightings(&all, sightings, &list->count);
    for (size_t i = 0; i < list->count; i++)
        list->servers[i] = sightings[i].server;
    if (known)
        *known = count_known(&all);
    announcements_release(&all);
    /* out of memory is said, and nothing kept */
    free(sightings);
    if (good) {
        note_name(client, list);
        return PERCUSS_RESULT_OK;
    }
    percuss_server_list_free(list);
    return error_set(PERCUSS_RESULT_NO_MEMORY, "a list of servers");
}

const struct percuss_server *servers_find(const struct percuss_server_list *list,
                                          const uint8_t id[16])
{
    for (size_t i = 0; i < list->count; i++)
        if (memcmp(list->servers[i].server, id, 16) == 0)
            return &list->servers[i];
    return NULL;
}

enum percuss_result servers_open(struct percuss_client *client)
{
    return announcements_open(client, &client->server_reader, &percuss_v1_ServerStatus_desc,
                              WIRE_TOPIC_SERVER_STATUS);
}

double servers_load(const struct percuss_server *server)
{
    if (strcmp(server->state, "ready") != 0)
        return INFINITY;
    double workers = fmax(1.0, server->workers);
    return server->queue_length / workers + (server->activity[0] ? 1.0 : 0.0);
}

size_t servers_reading(const struct percuss_client *client)
{
    dds_return_t count = dds_get_matched_subscriptions(client->request_writer, NULL, 0);
    return count > 0 ? (size_t)count : 0;
}

enum percuss_result servers_list(struct percuss_client *client, double timeout,
                                 struct percuss_server_list *list)
{
    uint8_t server[16];
    double deadline, settled = moment_now() + SERVERS_SETTLING;
    *list = (struct percuss_server_list){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = servers_open(client);
    /* our own server must be among them, if there is one; else any will do */
    const bool connected = announcements_server(client, server);
    while (result == PERCUSS_RESULT_OK) {
        result = servers_look(client, list, NULL);
        bool found = connected ? servers_find(list, server) != NULL : list->count > 0;
        double now = moment_now();
        /* complete when everyone who reads requests has said who he is, or has had time to */
        bool all = list->count >= servers_reading(client) || now >= fmin(settled, deadline);
        if (result != PERCUSS_RESULT_OK || (found && all))
            return result;
        percuss_server_list_free(list);
        if (now >= deadline)
            return error_set(connected ? PERCUSS_RESULT_TIMEOUT : PERCUSS_RESULT_NO_SERVER,
                             "no percussd has announced itself in DDS domain %u", client->domain);
        dds_sleepfor(ANNOUNCEMENTS_INTERVAL);
    }
    return result;
}

bool servers_is_wanted(const struct percuss_client *client, const uint8_t id[16])
{
    char text[PERCUSS_SERVER_ID_SIZE];
    for (int i = 0; i < 16; i++)
        snprintf(text + 2 * i, 3, "%02x", id[i]);
    return strncmp(text, client->wanted, strlen(client->wanted)) == 0;
}

/* Who may only look has no connected server: the first of those that he could mean. */
static enum percuss_result find_observed(struct percuss_client *client, double timeout,
                                         struct percuss_server *server)
{
    struct percuss_server_list servers;
    enum percuss_result result = servers_list(client, timeout, &servers);
    if (result != PERCUSS_RESULT_OK)
        return result;
    const struct percuss_server *found = NULL;
    for (size_t i = 0; i < servers.count && !found; i++)
        if (servers_is_wanted(client, servers.servers[i].server))
            found = &servers.servers[i];
    if (found) {
        *server = *found;
        pthread_mutex_lock(&client->lock);
        servers_describe(found->server, found, client->server_name);
        pthread_mutex_unlock(&client->lock);
    }
    /* its tasks go with the list */
    server->tasks = NULL;
    server->task_count = 0;
    percuss_server_list_free(&servers);
    return found
               ? PERCUSS_RESULT_OK
               : error_set(PERCUSS_RESULT_NO_SERVER,
                           "no percussd in DDS domain %u announces itself to us%s%s",
                           client->domain, client->wanted[0] ? " with an id that begins with " : "",
                           client->wanted);
}

enum percuss_result announcements_connected(struct percuss_client *client, double timeout,
                                            struct percuss_server *server)
{
    struct percuss_server_list servers;
    uint8_t id[16];
    char name[SERVERS_NAME_SIZE];
    if (client->observes)
        return find_observed(client, timeout, server);
    const bool connected = announcements_server(client, id);
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = exchange_check_connected(client);
    memcpy(name, client->server_name, sizeof name);
    pthread_mutex_unlock(&client->lock);
    /* another thread may have connected again in between */
    if (!connected && result == PERCUSS_RESULT_OK)
        result = failure_lost(name);
    if (result == PERCUSS_RESULT_OK)
        result = servers_list(client, timeout, &servers);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* it may have gone meanwhile, while others are there */
    const struct percuss_server *ours = servers_find(&servers, id);
    if (ours)
        *server = *ours;
    /* its tasks go with the list */
    server->tasks = NULL;
    server->task_count = 0;
    percuss_server_list_free(&servers);
    return ours ? PERCUSS_RESULT_OK : failure_lost(name);
}
