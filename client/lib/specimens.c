/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <percuss/specimen.h>
#include <stdlib.h>
#include <string.h>

#include "announcements.h"
#include "connect.h"
#include "convert.h"
#include "error.h"
#include "failure.h"
#include "library.h"
#include "moment.h"
#include "receive.h"

static int compare_names(const void *left, const void *right)
{
    const struct percuss_specimen *a = left, *b = right;
    return strcmp(a->name, b->name);
}

/* The specimens of a server among all announcements. False: no memory. */
static bool collect(const struct announcements *all, const uint8_t server[16],
                    struct percuss_specimen_list *list)
{
    list->specimens = calloc((size_t)all->count + 1, sizeof *list->specimens);
    bool good = list->specimens;
    for (int i = 0; good && i < all->count; i++) {
        const percuss_v1_Dents *wire = all->samples[i];
        if (all->infos[i].valid_data && memcmp(wire->server, server, 16) == 0)
            good = convert_announced_specimen(wire, &list->specimens[list->count++]);
    }
    return good;
}

/* One look at the specimens of a server. PENDING: not as many as it says. */
static enum percuss_result look_at_specimens(struct percuss_client *client,
                                             const struct percuss_server *server,
                                             struct percuss_specimen_list *list)
{
    struct announcements all;
    enum percuss_result result = announcements_read(client, client->dents_reader, &all);
    if (result != PERCUSS_RESULT_OK)
        return result;
    bool good = collect(&all, server->server, list);
    announcements_release(&all);
    if (good && list->count == server->specimens) {
        qsort(list->specimens, list->count, sizeof *list->specimens, compare_names);
        return PERCUSS_RESULT_OK;
    }
    percuss_specimen_list_free(list);
    return good ? PERCUSS_RESULT_PENDING
                : error_set(PERCUSS_RESULT_NO_MEMORY, "a list of specimens");
}

enum percuss_result specimens_list(struct percuss_client *client, double timeout,
                                   struct percuss_specimen_list *list)
{
    struct percuss_server server = {0};
    double deadline;
    *list = (struct percuss_specimen_list){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    /* opened first, so that the copies arrive while we wait for the server's announcement */
    if (result == PERCUSS_RESULT_OK)
        result = announcements_open(client, &client->dents_reader, &percuss_v1_Dents_desc,
                                    WIRE_TOPIC_DENTS);
    while (result == PERCUSS_RESULT_OK) {
        /* asked each time: the number changes */
        result = announcements_connected(client, timeout, &server);
        if (result != PERCUSS_RESULT_OK)
            return result;
        result = look_at_specimens(client, &server, list);
        if (result != PERCUSS_RESULT_PENDING)
            return result;
        if (moment_now() >= deadline)
            return error_set(PERCUSS_RESULT_TIMEOUT,
                             "%s has not announced all its %u specimens within %g s",
                             client->server_name, server.specimens, timeout);
        result = PERCUSS_RESULT_OK;
        dds_sleepfor(ANNOUNCEMENTS_INTERVAL);
    }
    return result;
}

/* Whether the server keeps a specimen of that name. */
static enum percuss_result specimens_find(struct percuss_client *client, const char *name,
                                          double timeout, bool *found)
{
    struct percuss_specimen_list list;
    enum percuss_result result = specimens_list(client, timeout, &list);
    *found = false;
    for (size_t i = 0; i < list.count; i++)
        *found = *found || strcmp(list.specimens[i].name, name) == 0;
    percuss_specimen_list_free(&list);
    return result;
}

/* The writer of requests to clear, made when first needed. */
static enum percuss_result open_writer(struct percuss_client *client, double deadline)
{
    enum percuss_result result = client_check_identity(client);
    if (result != PERCUSS_RESULT_OK)
        return result;
    pthread_mutex_lock(&client->lock);
    if (client->dents_writer <= 0)
        client->dents_writer =
            client_writer_create(client, &percuss_v1_Dents_desc, WIRE_TOPIC_DENTS);
    dds_entity_t writer = client->dents_writer, reader = client->reply_reader;
    pthread_mutex_unlock(&client->lock);
    return writer < 0 ? failure_dds("writer of " WIRE_TOPIC_DENTS, writer)
                      : connect_match(client, writer, reader, deadline);
}

enum percuss_result specimens_clear(struct percuss_client *client, const char *name, double timeout)
{
    percuss_v1_Dents wire = {.clear = true};
    bool found;
    double deadline;
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = specimens_find(client, name, timeout, &found);
    /* only stored specimens can be cleared */
    if (result == PERCUSS_RESULT_OK && !found)
        result = error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                           "specimen: %.63s: the server keeps none of that name", name);
    if (result == PERCUSS_RESULT_OK)
        result = open_writer(client, deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* told to the server that we stay with */
    announcements_server(client, wire.server);
    memcpy(wire.specimen, name, strlen(name) + 1); /* it fits: it was found */
    dds_return_t code = dds_write(client->dents_writer, &wire);
    if (code < 0)
        return failure_dds("writing to " WIRE_TOPIC_DENTS, code);
    /* done when it is not announced any more */
    while ((result = specimens_find(client, name, timeout, &found)) == PERCUSS_RESULT_OK && found) {
        if (moment_now() >= deadline)
            return error_set(PERCUSS_RESULT_TIMEOUT, "the server has not cleared %s", name);
        dds_sleepfor(ANNOUNCEMENTS_INTERVAL);
    }
    return result;
}
