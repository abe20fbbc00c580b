/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/service.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "daemon/dispatch.h"
#include "daemon/log.h"
#include "daemon/workers.h"
#include "endpoint/clock.h"
#include "endpoint/encode.h"

enum { REMEMBERED_CLIENTS = 4096 };

static const double megabyte = 1048576.0;
static const double flush_seconds = 1.0, cut_seconds = 2.0;

static bool create_stores(struct service *service)
{
    const struct settings *settings = service->settings;
    struct token_limits tokens = {
        .count = settings->token_count,
        .bytes = (size_t)(settings->token_megabytes * megabyte),
        .seconds = 60.0 * settings->token_minutes,
    };
    struct reply_limits replies = {
        .per_client = settings->replies_per_client,
        .bytes = (size_t)(settings->reply_megabytes * megabyte),
        .clients = REMEMBERED_CLIENTS,
        .seconds = 60.0 * settings->session_minutes,
    };
    service->tokens = token_store_create(&tokens);
    service->replies = reply_store_create(&replies);
    service->tables.folder = settings->tables;
    service->tables.replies = service->replies;
    service->tables.draining = &service->draining;
    bool good = table_cache_load(&service->tables);
    service->inline_responder = good ? responder_create(&service->tables, false) : NULL;
    good = service->tokens && service->replies && service->inline_responder;
    for (int lane = 0; lane < LANE_COUNT; lane++) {
        service->lanes[lane] = queue_create(settings->queue_capacity);
        good = good && service->lanes[lane];
    }
    return good;
}

static void *read_requests(void *argument)
{
    struct service *service = argument;
    struct endpoint_handler handler = dispatch_handler(service);
    endpoint_run(service->endpoint, &handler);
    return NULL;
}

static bool start_threads(struct service *service, struct fault *fault)
{
    if (workers_start(service))
        service->reader_runs = pthread_create(&service->reader, NULL, read_requests, service) == 0;
    if (!service->reader_runs)
        fault_set(fault, PERCUSS_INTERNAL, "threads: cannot be started");
    return service->reader_runs;
}

/* Announced before anybody can hit them. */
static bool open_dents(struct service *service, struct fault *fault)
{
    if (!service->specimens)
        return true;
    if (!endpoint_open_dents(service->endpoint, fault))
        return false;
    specimen_lane_announce(service->specimens, service->endpoint);
    return true;
}

struct service *service_create(const struct settings *settings, struct fault *fault)
{
    struct service *service = calloc(1, sizeof *service);
    if (!service) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return NULL;
    }
    service->settings = settings;
    ensembles_create(&service->ensembles);
    service->started = clock_now();
    if (snapshots_open(&service->snapshots, settings->catalogue, fault))
        goto failed;
    if (!create_stores(service)) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        goto failed;
    }
    if (settings->store[0] &&
        specimen_lane_open(settings->store, settings->stored_replies, &service->specimens, fault))
        goto failed;
    service->endpoint = endpoint_create(settings->domain, fault);
    if (!service->endpoint || !open_dents(service, fault) || !start_threads(service, fault))
        goto failed;
    /* bodies before the status: whoever sees a server finds its catalogue */
    if (!endpoint_announce_bodies(service->endpoint, service->snapshots.current->set, NULL))
        log_line(LEVEL_WARNING, "not all bodies could be announced");
    service_announce(service);
    return service;
failed:
    service_free(service);
    return NULL;
}

void service_free(struct service *service)
{
    if (service->reader_runs) {
        endpoint_stop(service->endpoint);
        pthread_join(service->reader, NULL);
    }
    for (int lane = 0; lane < LANE_COUNT; lane++) {
        if (service->lanes[lane])
            queue_close(service->lanes[lane]);
    }
    workers_join(service);
    if (service->endpoint)
        endpoint_flush(service->endpoint, flush_seconds);
    endpoint_free(service->endpoint);
    specimen_lane_close(service->specimens);
    responder_free(service->inline_responder);
    for (int lane = 0; lane < LANE_COUNT; lane++)
        queue_free(service->lanes[lane]);
    table_cache_free(&service->tables);
    reply_store_free(service->replies);
    token_store_free(service->tokens);
    snapshots_close(&service->snapshots);
    ensembles_release(&service->ensembles);
    free(service);
}

void service_reload(struct service *service)
{
    struct fault fault;
    struct snapshot *before;
    const char *path = service->settings->catalogue;
    if (snapshots_reload(&service->snapshots, path, &before, &fault)) {
        log_line(LEVEL_ERROR, "reload: %s; the old catalogue stays", fault.text);
        return;
    }
    struct snapshot *now = snapshots_hold(&service->snapshots);
    if (!endpoint_announce_bodies(service->endpoint, now->set, before->set))
        log_line(LEVEL_WARNING, "not all bodies could be announced");
    log_line(LEVEL_INFO, "reload: %zu bodies, catalogue revision %s%s", now->set->count,
             now->set->revision,
             strcmp(now->set->revision, before->set->revision) ? "" : " as before");
    snapshots_release(&service->snapshots, before);
    snapshots_release(&service->snapshots, now);
    service_announce(service);
}

static uint32_t waiting(const struct service *service)
{
    size_t length = 0;
    for (int lane = 0; lane < LANE_COUNT; lane++)
        length += queue_length(service->lanes[lane]);
    return (uint32_t)length;
}

void service_announce(struct service *service)
{
    struct snapshot *snapshot = snapshots_hold(&service->snapshots);
    percuss_v1_ServerStatus status = {
        .process = (uint32_t)getpid(),
        .workers = service->settings->workers,
        .bodies = (uint32_t)snapshot->set->count,
        .queue_length = waiting(service),
        .queue_capacity = LANE_COUNT * service->settings->queue_capacity,
        .answered = atomic_load(&service->answered),
        .refused = atomic_load(&service->refused),
        .uptime = clock_now() - service->started,
        .specimens = service->specimens ? (uint32_t)specimen_lane_count(service->specimens) : 0,
    };
    ensembles_describe(&service->ensembles, status.activity, &status.progress);
    const char *state = atomic_load(&service->draining) ? "draining" : "ready";
    double table = atomic_load(&service->tables.progress);
    if (!isnan(table)) {
        snprintf(status.activity, sizeof status.activity, "computing a contact table");
        status.progress = table;
    }
    snprintf(status.version, sizeof status.version, "%s", PERCUSS_VERSION);
    snprintf(status.state, sizeof status.state, "%s", state);
    snprintf(status.catalogue_revision, sizeof status.catalogue_revision, "%s",
             snapshot->set->revision);
    snprintf(status.catalogue, sizeof status.catalogue, "%.255s", service->settings->catalogue);
    snapshots_release(&service->snapshots, snapshot);
    gethostname(status.host, sizeof status.host - 1);
    endpoint_announce_status(service->endpoint, &status);
}

void service_tick(struct service *service)
{
    double now = clock_now();
    token_store_sweep(service->tokens, now);
    reply_store_sweep(service->replies, now);
    unsigned long long undelivered = atomic_load(&service->undelivered);
    if (undelivered > service->reported)
        log_line(LEVEL_WARNING, "%llu replies were not taken by their clients",
                 undelivered - service->reported);
    service->reported = undelivered;
    service_announce(service);
    struct snapshot *snapshot = snapshots_hold(&service->snapshots);
    neighbours_look(&service->neighbours, service->endpoint, snapshot->set->revision);
    snapshots_release(&service->snapshots, snapshot);
}

void service_begin_drain(struct service *service)
{
    atomic_store(&service->draining, true);
    service_announce(service);
}

bool service_drain(struct service *service, double seconds)
{
    double end = clock_now() + seconds;
    bool drained = true;
    for (int lane = 0; lane < LANE_COUNT; lane++)
        drained = queue_drain(service->lanes[lane], fmax(0.0, end - clock_now())) && drained;
    return drained;
}

bool service_cut_short(struct service *service)
{
    atomic_store(&service->ending, true);
    ensembles_cancel_all(&service->ensembles);
    return service_drain(service, cut_seconds);
}

struct envelope service_envelope(const struct service *service, const struct request_name *name,
                                 const struct snapshot *snapshot)
{
    return (struct envelope){
        .client = name->client,
        .server = endpoint_server(service->endpoint),
        .sequence = name->sequence,
        .revision = snapshot->set->revision,
        .version = PERCUSS_VERSION,
    };
}

static void count(struct service *service, const struct answer *answer)
{
    unsigned long long answered = 0, all = 1;
    if (answer->exchange == EXCHANGE_BATCH && answer->member_count > 0)
        all = answer->member_count;
    for (size_t i = 0; answer->reply && i < all; i++)
        answered += encode_status_has_result(answer->reply[i].status);
    if (answer->exchange == EXCHANGE_ENSEMBLE)
        answered = encode_status_has_result(answer->report->status);
    atomic_fetch_add(&service->answered, answered);
    atomic_fetch_add(&service->refused, all - answered);
}

void service_deliver(struct service *service, const struct request_name *name,
                     struct answer *answer)
{
    if (!answer) {
        reply_store_forget(service->replies, name);
        log_line(LEVEL_ERROR, "request %llu: no memory for its reply",
                 (unsigned long long)name->sequence);
        return;
    }
    count(service, answer);
    /* stored first: who has seen the reply finds it when asking again */
    if (answer->passing)
        reply_store_forget(service->replies, name);
    else
        reply_store_keep(service->replies, name, answer);
    if (endpoint_reply(service->endpoint, name->client, answer) != DELIVERY_DONE)
        atomic_fetch_add(&service->undelivered, 1);
}
