/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/shared.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "daemon/limits.h"
#include "daemon/log.h"
#include "daemon/pool.h"
#include "daemon/queue.h"
#include "exchange/clock.h"
#include "respond/responder.h"

/* The lock is held. */
static void activity_forget(struct activity *activity)
{
    activity->owner = NULL;
    activity->text[0] = '\0';
    activity->progress = activity->begun = NAN;
}

void activity_create(struct activity *activity)
{
    pthread_mutex_init(&activity->lock, NULL);
    activity_forget(activity);
}

void activity_release(struct activity *activity)
{
    pthread_mutex_destroy(&activity->lock);
}

void activity_set(struct activity *activity, const void *owner, double progress, const char *format,
                  ...)
{
    va_list arguments;
    va_start(arguments, format);
    pthread_mutex_lock(&activity->lock);
    if (!activity->owner || activity->owner == owner) {
        if (!activity->owner)
            activity->begun = clock_now();
        activity->owner = owner;
        vsnprintf(activity->text, sizeof activity->text, format, arguments);
        activity->progress = progress;
    }
    pthread_mutex_unlock(&activity->lock);
    va_end(arguments);
}

void activity_clear(struct activity *activity, const void *owner)
{
    pthread_mutex_lock(&activity->lock);
    if (activity->owner == owner)
        activity_forget(activity);
    pthread_mutex_unlock(&activity->lock);
}

void activity_read(struct activity *activity, char *text, size_t size, double *progress)
{
    pthread_mutex_lock(&activity->lock);
    snprintf(text, size, "%s", activity->text);
    *progress = activity->progress;
    pthread_mutex_unlock(&activity->lock);
}

double activity_begun(struct activity *activity)
{
    pthread_mutex_lock(&activity->lock);
    double begun = activity->begun;
    pthread_mutex_unlock(&activity->lock);
    return begun;
}

void ensembles_create(struct ensembles *ensembles)
{
    pthread_mutex_init(&ensembles->lock, NULL);
    LIST_INIT(&ensembles->all);
}

void ensembles_release(struct ensembles *ensembles)
{
    pthread_mutex_destroy(&ensembles->lock);
}

void ensembles_enter(struct ensembles *ensembles, struct ensemble_entry *entry)
{
    pthread_mutex_lock(&ensembles->lock);
    LIST_INSERT_HEAD(&ensembles->all, entry, all);
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_leave(struct ensembles *ensembles, struct ensemble_entry *entry)
{
    pthread_mutex_lock(&ensembles->lock);
    LIST_REMOVE(entry, all);
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_cancel(struct ensembles *ensembles, const uint8_t client[16], uint64_t sequence)
{
    struct ensemble_entry *entry;
    pthread_mutex_lock(&ensembles->lock);
    LIST_FOREACH(entry, &ensembles->all, all)
    {
        if (entry->sequence == sequence && memcmp(entry->client, client, 16) == 0)
            atomic_store(&entry->cancelled, true);
    }
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_visit_waiting(struct ensembles *ensembles,
                             void (*visit)(void *context, const struct ensemble_entry *waiting),
                             void *context)
{
    struct ensemble_entry *entry;
    pthread_mutex_lock(&ensembles->lock);
    LIST_FOREACH(entry, &ensembles->all, all)
    {
        if (!atomic_load(&entry->running))
            visit(context, entry);
    }
    pthread_mutex_unlock(&ensembles->lock);
}

static void table_log_omitted(const struct fault *fault)
{
    log_line(LEVEL_WARNING, "table left out: %s", fault->text);
}

static void table_log_line(bool warning, const char *text)
{
    log_line(warning ? LEVEL_WARNING : LEVEL_INFO, "%s", text);
}

static const struct table_listener table_log = {table_log_omitted, table_log_line};

enum { REMEMBERED_CLIENTS = 4096 };

static const double MEGABYTE = 1048576.0;

/* The number of workers of a lane that one client may have at once. */
static size_t lane_share(const struct settings *settings, enum lane lane)
{
    return lane == LANE_LONG        ? settings->workers
           : lane == LANE_ENSEMBLES ? 1 /* it has threads of its own */
                                    : QUEUE_WHOLE;
}

static bool create_stores(struct shared *shared)
{
    const struct settings *settings = shared->settings;
    /* how many, and how long they stay */
    struct token_limits tokens = {
        .count = settings->token_count,
        .bytes = (size_t)(settings->token_megabytes * MEGABYTE),
        .seconds = 60.0 * settings->token_minutes,
    };
    struct reply_limits replies = {
        .per_client = settings->replies_per_client,
        .bytes = (size_t)(settings->reply_megabytes * MEGABYTE),
        .clients = REMEMBERED_CLIENTS,
        .seconds = 60.0 * settings->session_minutes,
    };
    /* shared_release frees those that were created */
    shared->tokens = token_store_create(&tokens);
    shared->replies = reply_store_create(&replies);
    bool good = shared->tokens && shared->replies;
    for (int lane = 0; lane < LANE_COUNT; lane++) {
        shared->lanes[lane] = queue_create(settings->queue_capacity, lane_share(settings, lane));
        good = good && shared->lanes[lane];
    }
    return table_cache_create(&shared->tables, settings, &table_log) && good;
}

bool shared_create(struct shared *shared, const struct settings *settings, struct fault *fault)
{
    shared->settings = settings;
    shared->started = clock_now();
    shared->prepared.most_each =
        settings->body_megabytes
            ? (size_t)(settings->body_megabytes * MEGABYTE) / limits_solving_threads(settings)
            : SIZE_MAX;
    ensembles_create(&shared->ensembles);
    activity_create(&shared->activity);
    activity_create(&shared->reduction);
    if (snapshots_open(&shared->snapshots, (size_t)(settings->box_megabytes * MEGABYTE),
                       settings->catalogue, &shared->tables, settings->bodies, fault))
        return false;
    /* readers of the status may have another working folder */
    if (!realpath(settings->catalogue, shared->catalogue))
        snprintf(shared->catalogue, sizeof shared->catalogue, "%s", settings->catalogue);
    if (create_stores(shared))
        return true;
    fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    return false;
}

void shared_release(struct shared *shared)
{
    for (int lane = 0; lane < LANE_COUNT; lane++)
        queue_free(shared->lanes[lane]);
    table_cache_release(&shared->tables);
    reply_store_free(shared->replies);
    token_store_free(shared->tokens);
    snapshots_close(&shared->snapshots);
    activity_release(&shared->reduction);
    activity_release(&shared->activity);
    ensembles_release(&shared->ensembles);
}

enum percuss_status shared_table_goes_on(void *context, const struct table_maker *maker,
                                         double done, struct fault *fault)
{
    struct shared *shared = context;
    heartbeat_beat();
    activity_set(&shared->activity, maker, done, "computing a contact table");
    if (atomic_load(&shared->draining))
        return fault_set(fault, PERCUSS_BUSY, SHARED_SHUTTING_DOWN);
    if (reply_store_is_gone(shared->replies, maker->client))
        return fault_set(fault, PERCUSS_TIMEOUT, SHARED_CLIENT_GONE);
    return PERCUSS_OK;
}

void shared_table_ended(void *context, const struct table_maker *maker)
{
    struct shared *shared = context;
    activity_clear(&shared->activity, maker);
}

static void shared_complain(const struct envelope *envelope, const char *text)
{
    log_about(LEVEL_ERROR, &(struct log_request){envelope->client, envelope->sequence},
              "internal: %s", text);
}

struct responder *shared_responder(struct shared *shared, enum lane lane)
{
    struct respond_means means = {
        .tokens = shared->tokens,
        .account = &shared->prepared,
        .limit = shared->settings->limit_seconds,
        .beat = heartbeat_beat,
        .complain = shared_complain,
    };
    if (lane == LANE_TABLES)
        means.tables = (struct table_wait){shared_table_goes_on, shared_table_ended, shared};
    struct responder *responder = responder_create(&means);
    if (responder)
        responder->lane = lane;
    return responder;
}
