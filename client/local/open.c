/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The beginning and the end of a client. */

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "catalogue/shipped.h"
#include "desk.h"
#include "error.h"
#include "exchange/clock.h"
#include "instance.h"
#include "library.h"

static const double MEGABYTE = 1048576.0;

struct percuss_local_config percuss_local_config_default(void)
{
    return (struct percuss_local_config){.first_sequence = 1};
}

void local_free(struct percuss_client *client)
{
    if (!client)
        return;
    outstanding_clear(client);
    desk_free_all(client);
    if (client->snapshot)
        snapshots_release(&client->snapshots, client->snapshot);
    table_cache_release(&client->tables);
    token_store_free(client->tokens);
    snapshots_close(&client->snapshots);
    specimen_store_close(client->specimens);
    pthread_mutex_destroy(&client->specimens_lock);
    pthread_mutex_destroy(&client->lock);
    free(client);
}

static enum percuss_result open_refuse(enum percuss_status status, const struct fault *fault)
{
    return error_set(status == PERCUSS_INTERNAL ? PERCUSS_RESULT_NO_MEMORY
                                                : PERCUSS_RESULT_INVALID_ARGUMENT,
                     "%s", fault->text);
}

/* From the file that is given or installed; members of `config` go before. */
static enum percuss_result read_settings(const struct percuss_local_config *config,
                                         struct settings *settings)
{
    struct fault fault = {{0}};
    char *shipped = config->settings ? NULL : shipped_find("percussd.yaml");
    const char *path = config->settings ? config->settings : shipped;
    *settings = settings_default();
    settings->shipped = !config->settings;
    enum percuss_status status = path ? settings_load(path, settings, &fault) : PERCUSS_OK;
    free(shipped);
    if (status)
        return open_refuse(status, &fault);
    /* without given settings there is no limit of time: answers depend on no clock */
    if (!config->settings)
        settings->limit_seconds = settings->token_minutes = INFINITY;
    if (config->catalogue && snprintf(settings->catalogue, sizeof settings->catalogue, "%s",
                                      config->catalogue) >= (int)sizeof settings->catalogue)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "catalogue: a path of at most %zu bytes is allowed",
                         sizeof settings->catalogue - 1);
    if (settings->catalogue[0])
        return PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "catalogue: none is given, and none is "
                                                      "installed with the library");
}

/* Those that are installed are read only. */
static enum percuss_result load_tables(struct percuss_client *client)
{
    const struct settings *settings = &client->settings;
    if (!table_cache_create(&client->tables, settings, NULL))
        return error_set(PERCUSS_RESULT_NO_MEMORY, "contact tables");
    for (size_t i = 0; i < SETTINGS_FOLDERS_MOST && settings->tables[i][0]; i++)
        if (access(settings->tables[i], R_OK | X_OK) != 0)
            return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "tables: %.300s: cannot be read: %s",
                             settings->tables[i], strerror(errno));
    if (settings->shipped)
        client->tables.keep[0] = '\0';
    return PERCUSS_RESULT_OK;
}

static enum percuss_result load(struct percuss_client *client)
{
    const struct settings *settings = &client->settings;
    const struct token_limits tokens = {
        .count = settings->token_count,
        .bytes = (size_t)(settings->token_megabytes * MEGABYTE),
        .seconds = 60.0 * settings->token_minutes,
    };
    struct fault fault = {{0}};
    /* the catalogue, and the settings of its snapshots */
    enum percuss_status status =
        snapshots_open(&client->snapshots, (size_t)settings->box_megabytes << 20,
                       settings->catalogue, &client->tables, settings->bodies, &fault);
    if (status)
        return open_refuse(status, &fault);
    client->snapshot = snapshots_hold(&client->snapshots);
    client->tokens = token_store_create(&tokens);
    if (!client->tokens)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "state tokens");
    /* dents outlive it where the program has said so */
    if (!settings->shipped && settings->store[0])
        status = specimen_store_open(settings->store, settings->stored_replies, &client->specimens,
                                     &fault);
    return status ? open_refuse(status, &fault) : load_tables(client);
}

enum percuss_result percuss_local_open(const struct percuss_local_config *config,
                                       struct percuss_client **client)
{
    if (ERROR_NULL(client))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    struct percuss_local_config chosen = config ? *config : percuss_local_config_default();
    *client = NULL;
    if (chosen.first_sequence == 0)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "first_sequence: 0 means a ping");
    struct percuss_client *made = calloc(1, sizeof *made);
    if (!made)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a client");
    pthread_mutex_init(&made->lock, NULL);
    pthread_mutex_init(&made->specimens_lock, NULL);
    made->operations = &LIBRARY_OPERATIONS;
    memcpy(made->id, chosen.id, sizeof made->id);
    made->next_sequence = chosen.first_sequence;
    made->started = clock_now();
    /* settings and catalogue */
    enum percuss_result result = read_settings(&chosen, &made->settings);
    if (result == PERCUSS_RESULT_OK)
        result = load(made);
    if (result != PERCUSS_RESULT_OK) {
        local_free(made);
        return result;
    }
    made->threads = chosen.threads ? chosen.threads : made->settings.workers;
    *client = made;
    return PERCUSS_RESULT_OK;
}
