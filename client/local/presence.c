/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The server and its bodies: this process, and its catalogue. */

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "convert.h"
#include "error.h"
#include "exchange/describe.h"
#include "exchange/text.h"
#include "instance.h"
#include "library.h"
#include "lists.h"
#include "moment.h"

void local_id(const struct percuss_client *client, uint8_t id[16])
{
    memcpy(id, client->id, 16);
}

bool local_observes(const struct percuss_client *client)
{
    (void)client;
    return false;
}

bool local_warning(const struct percuss_client *client, char text[PERCUSS_WARNING_SIZE])
{
    (void)client;
    text[0] = '\0';
    return false;
}

bool local_server(struct percuss_client *client, uint8_t server[16])
{
    (void)client;
    memcpy(server, INSTANCE_SERVER, 16);
    return true;
}

enum percuss_result local_connect(struct percuss_client *client, double timeout)
{
    double deadline;
    (void)client;
    return moment_deadline(timeout, &deadline);
}

enum percuss_result local_ping(struct percuss_client *client, double timeout, double *round_trip)
{
    *round_trip = 0.0;
    return local_connect(client, timeout);
}

void local_watch(struct percuss_client *client, percuss_watch_function *watch, void *context)
{
    pthread_mutex_lock(&client->lock);
    client->watching = watching_begin(watch, context);
    pthread_mutex_unlock(&client->lock);
}

static void describe(struct percuss_client *client, struct percuss_server *server)
{
    const struct body_set *set = client->snapshot->set;
    *server = (struct percuss_server){
        .process = (uint32_t)getpid(),
        .workers = client->threads,
        .bodies = (uint32_t)set->count,
        .answered = atomic_load(&client->answered),
        .refused = atomic_load(&client->refused),
        .uptime = moment_now() - client->started,
        .progress = NAN,
    };
    pthread_mutex_lock(&client->specimens_lock);
    if (client->specimens)
        server->specimens = (uint32_t)specimen_store_count(client->specimens);
    pthread_mutex_unlock(&client->specimens_lock);
    memcpy(server->server, INSTANCE_SERVER, sizeof server->server);
    COPY_TEXT(server->version, PERCUSS_VERSION);
    COPY_TEXT(server->catalogue_revision, set->revision);
    COPY_TEXT(server->catalogue, client->settings.catalogue);
    COPY_TEXT(server->state, "in process");
    gethostname(server->host, sizeof server->host - 1);
}

enum percuss_result local_servers(struct percuss_client *client, double timeout,
                                  struct percuss_server_list *list)
{
    double deadline;
    *list = (struct percuss_server_list){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    list->servers = calloc(1, sizeof *list->servers);
    if (!list->servers)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a list of servers");
    list->count = 1;
    describe(client, list->servers);
    return PERCUSS_RESULT_OK;
}

enum percuss_result local_bodies(struct percuss_client *client, double timeout,
                                 struct percuss_body_list *list)
{
    const struct body_set *set = client->snapshot->set;
    double deadline;
    *list = (struct percuss_body_list){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    struct describer describer;
    struct lists_bodies made = lists_begin_bodies(set->count);
    bool good = describe_begin(&describer, set);
    if (good) {
        for (size_t i = 0; i < set->count; i++) {
            percuss_v1_Body wire;
            describe_body(&describer, &set->bodies[i], &wire);
            COPY_TEXT(wire.catalogue_revision, set->revision);
            lists_add_body(&made, &wire);
        }
        describe_end(&describer);
    }
    made.failed = made.failed || !good;
    return lists_end_bodies(&made, list);
}
