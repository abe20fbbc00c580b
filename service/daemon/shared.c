/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/shared.h"

#include <stdio.h>
#include <stdlib.h>

#include "daemon/queue.h"
#include "daemon/table_log.h"
#include "exchange/clock.h"

enum { REMEMBERED_CLIENTS = 4096 };

static const double MEGABYTE = 1048576.0;

/* How many workers of a lane one client may have at once. */
static size_t share_of(const struct settings *settings, enum lane lane)
{
    return lane == LANE_LONG        ? settings->workers
           : lane == LANE_ENSEMBLES ? 1 /* it has threads of its own */
                                    : QUEUE_WHOLE;
}

static bool create_stores(struct shared *shared)
{
    const struct settings *settings = shared->settings;
    /* how much is remembered, and how long */
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
    /* all are tried: what was made is released */
    shared->tokens = token_store_create(&tokens);
    shared->replies = reply_store_create(&replies);
    bool good = shared->tokens && shared->replies;
    for (int lane = 0; lane < LANE_COUNT; lane++) {
        shared->lanes[lane] = queue_create(settings->queue_capacity, share_of(settings, lane));
        good = good && shared->lanes[lane];
    }
    return table_cache_create(&shared->tables, settings, &table_log) && good;
}

bool shared_create(struct shared *shared, const struct settings *settings, struct fault *fault)
{
    shared->settings = settings;
    shared->started = clock_now();
    ensembles_create(&shared->ensembles);
    activity_create(&shared->activity);
    activity_create(&shared->reduction);
    if (snapshots_open(&shared->snapshots, settings->catalogue, &shared->tables, settings->bodies,
                       fault))
        return false;
    /* others may have another working folder */
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
