/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/service.h"

#include <malloc.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "daemon/dispatch.h"
#include "daemon/identity.h"
#include "daemon/log.h"
#include "daemon/pool.h"
#include "daemon/reducer.h"
#include "daemon/specimen_lane.h"
#include "daemon/status.h"
#include "daemon/store_job.h"
#include "exchange/clock.h"
#include "respond/responder.h"
#include "store/database_check.h"
#include "wire_clock.h"

/* Ensembles that run side by side, each of another client and with threads of its own. */
enum { ENSEMBLES_AT_ONCE = 3 };
/* Bytes: a thousand replies and their copies in DDS. */
static const size_t READER_MEMORY = 8 * 1024 * 1024;
static const double FLUSH_SECONDS = 1.0, CUT_SECONDS = 2.0;
/* So often bodies in use are marked, for other daemons with the same folder. */
static const double TIDY_SECONDS = 86400.0;
/* Free bytes between others that the allocator may keep; and how often they are given back, as the
 * next requests take them from the system again. */
static const size_t SLACK = 64 * 1024 * 1024;
static const double TRIM_SECONDS = 60.0;
/* Smaller steps of the time of day are not logged. */
static const double TOLD_SECONDS = 1.0;

struct service {
    struct shared shared;
    struct dispatch *dispatch; /* the reading thread's while it runs */
    pthread_t reader;
    bool reader_runs;
    struct heartbeat reader_heartbeat;
    bool is_stuck; /* as the log says */
    struct pool *pool;
    struct neighbours neighbours;
    struct reducer reducer;
    struct identity identity;
    struct wire_clock clock;     /* the main thread's */
    size_t resident;             /* bytes, at the first tick */
    double trimmed;              /* the allocator; monotonic, s */
    double tidied;               /* the folder of bodies; monotonic, s */
    bool metrics_fail;           /* as the log says */
    unsigned long long reported; /* of the undelivered replies: those that are in the log */
};

static bool open_specimens(struct shared *shared, struct fault *fault)
{
    const struct settings *settings = shared->settings;
    char remark[256];
    if (settings->store[0] && database_remark_volume(settings->store, remark, sizeof remark))
        log_line(LEVEL_WARNING, "store: %s: %s", settings->store, remark);
    return !settings->store[0] ||
           specimen_lane_open(settings->store, settings->stored_replies, &shared->metrics.commits,
                              &shared->specimens, fault) == PERCUSS_OK;
}

/* Without security every host that reaches this machine's ports may ask. */
static void tell_who_may_ask(const char *security)
{
    if (geteuid() == 0)
        log_line(LEVEL_WARNING, "runs as root: any other user would do");
    const char *uri = getenv("CYCLONEDDS_URI");
    if (wire_is_configured())
        log_line(LEVEL_INFO, "CYCLONEDDS_URI is %.300s", uri);
    else
        log_line(LEVEL_INFO, "CYCLONEDDS_URI is not set: this machine alone is heard");
    if (security)
        log_line(LEVEL_INFO, "DDS Security: the identity in %s", security);
    else if (wire_is_configured())
        log_line(LEVEL_WARNING, "CYCLONEDDS_URI is set and the setting security is not: whoever "
                                "reaches this machine's ports may ask");
}

/* Specimens are announced before a request can name them. */
static bool open_endpoint(struct service *service, const uint8_t *server, struct fault *fault)
{
    struct shared *shared = &service->shared;
    const struct settings *settings = shared->settings;
    const char *security = settings->security[0] ? settings->security : NULL;
    log_take_dds();
    tell_who_may_ask(security);
    shared->endpoint = endpoint_create(settings->domain, settings->partition, security,
                                       settings->limit_clients, server, fault);
    if (!shared->endpoint)
        return false;
    identity_read(&service->identity, security);
    identity_revoke(service->identity.folder);
    shared->identity_end = service->identity.validity.end;
    identity_look(&service->identity, clock_now(), time(NULL));
    if (!shared->specimens)
        return true;
    if (!endpoint_open_dents(shared->endpoint, fault))
        return false;
    specimen_lane_announce(shared->specimens, shared->endpoint);
    return true;
}

/* Adds the workers of a lane. */
static bool add_workers(struct service *service, enum lane lane, unsigned count,
                        struct fault *fault)
{
    struct shared *shared = &service->shared;
    bool patient = lane == LANE_LONG || lane == LANE_TABLES || lane == LANE_ENSEMBLES;
    struct queue *slower = lane == LANE_SHORT ? shared->lanes[LANE_LONG] : NULL;
    for (unsigned i = 0; i < count; i++) {
        struct responder *responder = shared_responder(shared, lane);
        if (!responder) {
            fault_set(fault, PERCUSS_INTERNAL, "out of memory");
            return false;
        }
        if (!pool_add(service->pool, shared->lanes[lane], slower, responder,
                      patient ? POOL_PATIENT_NICE : 0)) {
            fault_set(fault, PERCUSS_INTERNAL, "threads: cannot be started");
            return false;
        }
    }
    return true;
}

static bool start_workers(struct service *service, struct fault *fault)
{
    unsigned workers = service->shared.settings->workers;
    unsigned specimens = service->shared.specimens ? 1 : 0;
    /* long solves of one client can use all processors, and leave a worker to others */
    service->pool = pool_create(2 * workers + 2 + ENSEMBLES_AT_ONCE + specimens);
    if (!service->pool) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return false;
    }
    return add_workers(service, LANE_SHORT, workers, fault) &&
           add_workers(service, LANE_LONG, workers + 1, fault) &&
           add_workers(service, LANE_TABLES, 1, fault) &&
           add_workers(service, LANE_ENSEMBLES, ENSEMBLES_AT_ONCE, fault) &&
           add_workers(service, LANE_SPECIMENS, specimens, fault);
}

static void *read_requests(void *argument)
{
    struct service *service = argument;
    struct endpoint_handler handler = dispatch_handler(service->dispatch);
    memory_keep(READER_MEMORY);
    pthread_setname_np(pthread_self(), "reader");
    heartbeat_adopt(&service->reader_heartbeat);
    heartbeat_beat();
    endpoint_run(service->shared.endpoint, &handler);
    return NULL;
}

static bool start_reader(struct service *service, struct fault *fault)
{
    service->dispatch = dispatch_create(&service->shared);
    if (!service->dispatch)
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    else if (pthread_create(&service->reader, NULL, read_requests, service) == 0)
        service->reader_runs = true;
    else
        fault_set(fault, PERCUSS_INTERNAL, "threads: cannot be started");
    return service->reader_runs;
}

static void announce_bodies(struct service *service, const struct body_set *set,
                            const struct body_set *before)
{
    if (!endpoint_announce_bodies(service->shared.endpoint, set, before))
        log_line(LEVEL_WARNING, "not all bodies could be announced");
}

static void complain_of_missing(const struct body_set *set)
{
    for (size_t i = 0; i < set->order_count; i++)
        if (set->orders[i].missing)
            log_line(LEVEL_ERROR, "%s is left out: %s", set->orders[i].id,
                     body_order_news(&set->orders[i]).text);
}

static void tidy_bodies(struct service *service)
{
    const struct settings *settings = service->shared.settings;
    service->tidied = clock_now();
    if (settings->bodies[0])
        reducer_tidy(settings->bodies, service->shared.snapshots.current->set,
                     settings->bodies_days);
}

struct service *service_create(const struct settings *settings, const uint8_t *server,
                               struct fault *fault)
{
    struct service *service = calloc(1, sizeof *service);
    if (!service) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return NULL;
    }
    struct shared *shared = &service->shared;
    service->clock = wire_clock_start();
    reducer_begin(&service->reducer, settings->bodies);
    if (!shared_create(shared, settings, fault) || !open_specimens(shared, fault) ||
        !open_endpoint(service, server, fault) || !start_workers(service, fault) ||
        !start_reader(service, fault)) {
        service_free(service);
        return NULL;
    }
    /* bodies before the status: a client that sees a server finds its catalogue */
    const struct body_set *set = shared->snapshots.current->set;
    announce_bodies(service, set, NULL);
    complain_of_missing(set);
    tidy_bodies(service);
    status_announce(shared);
    log_line(LEVEL_INFO, "ready: domain %u%s%s, %zu bodies, catalogue revision %s",
             settings->domain, settings->partition[0] ? ", partition " : "", settings->partition,
             set->count, set->revision);
    return service;
}

void service_free(struct service *service)
{
    struct shared *shared = &service->shared;
    reducer_end(&service->reducer);
    /* the threads end */
    if (service->reader_runs) {
        endpoint_stop(shared->endpoint);
        pthread_join(service->reader, NULL);
    }
    for (int lane = 0; lane < LANE_COUNT; lane++) {
        if (shared->lanes[lane])
            queue_close(shared->lanes[lane]);
    }
    pool_join(service->pool);
    dispatch_free(service->dispatch);
    /* the data that they shared is released */
    if (shared->endpoint)
        endpoint_flush(shared->endpoint, FLUSH_SECONDS);
    endpoint_free(shared->endpoint);
    specimen_lane_close(shared->specimens);
    shared_release(shared);
    free(service);
}

static void load_again(struct service *service)
{
    struct fault fault;
    struct shared *shared = &service->shared;
    struct snapshot *before;
    if (snapshots_reload(&shared->snapshots, shared->settings->catalogue, &before, &fault)) {
        log_line(LEVEL_ERROR, "reload: %s; the old catalogue stays", fault.text);
        atomic_fetch_add(&shared->metrics.failed_reloads, 1);
        reducer_unloaded(&service->reducer, shared->snapshots.current->set, &fault);
        return;
    }
    atomic_fetch_add(&shared->metrics.reloads, 1);
    /* only this thread replaces it */
    const struct body_set *now = shared->snapshots.current->set;
    announce_bodies(service, now, before->set);
    log_line(LEVEL_INFO, "reload: %zu bodies, catalogue revision %s%s", now->count, now->revision,
             strcmp(now->revision, before->set->revision) ? "" : " as before");
    snapshots_release(&shared->snapshots, before);
    complain_of_missing(now);
    tidy_bodies(service);
    status_announce(shared);
}

void service_reload(struct service *service)
{
    reducer_retry(&service->reducer);
    identity_revoke(service->identity.folder);
    load_again(service);
}

void service_back_up(struct service *service)
{
    struct shared *shared = &service->shared;
    if (!shared->specimens) {
        log_line(LEVEL_WARNING, "store: none is given in the settings");
        return;
    }
    struct job *displaced = NULL, *job = backup_job_create(shared);
    if (!job)
        log_line(LEVEL_WARNING, "store: not looked through: out of memory");
    else if (!queue_put(shared->lanes[LANE_SPECIMENS], job, &displaced))
        job_refuse(job);
    if (displaced)
        job_refuse(displaced);
}

/* A file that cannot be written is logged once. */
static void write_metrics(struct service *service)
{
    struct fault fault;
    const char *path = service->shared.settings->metrics;
    bool good = !path[0] || status_write_metrics(&service->shared, path, &fault);
    if (!good && !service->metrics_fail)
        log_line(LEVEL_ERROR, "%s", fault.text);
    service->metrics_fail = !good;
}

static void look_at_reducer(struct service *service)
{
    struct shared *shared = &service->shared;
    struct reducer *reducer = &service->reducer;
    if (reducer_look(reducer, shared->snapshots.current->set))
        load_again(service);
    if (reducer->child)
        activity_set(&shared->reduction, reducer, reducer->done,
                     reducer->adding ? "solving for sites of %s" : "reducing %s", reducer->id);
    else
        activity_clear(&shared->reduction, reducer);
}

/* A time of day that was set back holds up threads of DDS, so that no client finds this daemon. */
static void look_at_clock(struct service *service)
{
    const double step = wire_clock_step(&service->clock);
    if (wire_clock_is_back(step))
        endpoint_rouse(service->shared.endpoint);
    if (fabs(step) >= TOLD_SECONDS)
        log_line(step < 0.0 ? LEVEL_WARNING : LEVEL_INFO,
                 "the time of day of this machine went %s by %.0f s%s",
                 step < 0.0 ? "back" : "forward", fabs(step),
                 step < 0.0 ? ": clients may have missed this daemon for a second" : "");
}

/* What is dropped is free for other requests, and not for other programs. */
static void look_at_memory(struct service *service, double now)
{
    const size_t resident = status_resident_bytes();
    if (service->resident == 0)
        service->resident = resident;
    if (now - service->trimmed < TRIM_SECONDS ||
        resident < service->resident + status_kept_bytes(&service->shared) + SLACK)
        return;
    service->trimmed = now;
    malloc_trim(0);
}

void service_tick(struct service *service)
{
    struct shared *shared = &service->shared;
    look_at_clock(service);
    look_at_reducer(service);
    double now = clock_now();
    if (now - service->tidied > TIDY_SECONDS)
        tidy_bodies(service);
    token_store_sweep(shared->tokens, now);
    reply_store_sweep(shared->replies, now);
    look_at_memory(service, now);
    log_sum_up(false);
    unsigned long long undelivered = atomic_load(&shared->undelivered);
    if (undelivered > service->reported)
        log_line(LEVEL_WARNING, "%llu replies were not taken by their clients",
                 undelivered - service->reported);
    service->reported = undelivered;
    unsigned long long strange = endpoint_strange(shared->endpoint);
    if (strange)
        log_line(LEVEL_WARNING, "%llu requests bore the id of another client: ignored", strange);
    identity_look(&service->identity, now, time(NULL));
    status_announce(shared);
    write_metrics(service);
    neighbours_look(&service->neighbours, shared);
    atomic_store(&shared->others, service->neighbours.others);
}

bool service_is_alive(struct service *service, double patience)
{
    double reader = heartbeat_silence(&service->reader_heartbeat, clock_now());
    double workers = pool_silence(service->pool);
    bool stuck = fmax(reader, workers) > patience;
    if (stuck && !service->is_stuck)
        log_line(LEVEL_ERROR, "%s: has not moved for %.0f s: the watchdog is no longer fed",
                 reader > workers ? "the reading thread" : "a worker", fmax(reader, workers));
    else if (!stuck && service->is_stuck)
        log_line(LEVEL_WARNING, "all threads move again");
    service->is_stuck = stuck;
    /* the reading thread beats before the next call */
    endpoint_nudge(service->shared.endpoint);
    return !stuck;
}

void service_describe(struct service *service, char *text, size_t size)
{
    status_describe(&service->shared, text, size);
}

void service_begin_drain(struct service *service)
{
    atomic_store(&service->shared.draining, true);
    reducer_end(&service->reducer);
    activity_clear(&service->shared.reduction, &service->reducer);
    status_announce(&service->shared);
}

bool service_drain(struct service *service, double seconds)
{
    double end = clock_now() + seconds;
    bool drained = true;
    for (int lane = 0; lane < LANE_COUNT; lane++)
        drained = queue_drain(service->shared.lanes[lane], fmax(0.0, end - clock_now())) && drained;
    return drained;
}

bool service_cut_short(struct service *service)
{
    for (int lane = 0; lane < LANE_COUNT; lane++)
        queue_cancel(service->shared.lanes[lane]);
    return service_drain(service, CUT_SECONDS);
}
