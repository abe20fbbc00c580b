/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/pool.h"

#include <assert.h>
#include <limits.h>
#include <malloc.h>
#include <math.h>
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "exchange/clock.h"
#include "respond/responder.h"

/* Per thread: the beats come from deep inside a solve, which does not know its thread. */
static _Thread_local struct heartbeat *own_heartbeat;

static void heartbeat_set(double last)
{
    if (own_heartbeat)
        atomic_store_explicit(&own_heartbeat->last, last, memory_order_relaxed);
}

void heartbeat_adopt(struct heartbeat *heartbeat)
{
    own_heartbeat = heartbeat;
}

void heartbeat_beat(void)
{
    if (own_heartbeat)
        heartbeat_set(clock_now());
}

void heartbeat_rest(void)
{
    heartbeat_set(0.0);
}

double heartbeat_silence(const struct heartbeat *heartbeat, double now)
{
    double last = atomic_load_explicit(&heartbeat->last, memory_order_relaxed);
    return last > 0.0 ? fmax(0.0, now - last) : 0.0;
}

/* Bytes of one allocation: a larger one has a mapping of its own, which is unmapped when it is
 * freed (M_MMAP_THRESHOLD, mallopt(3)). */
static const size_t PIECE = 64 * 1024;

void memory_keep(size_t bytes)
{
    /* free memory at a heap's end stays */
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    size_t count = bytes / PIECE;
    void **pieces = calloc(count, sizeof *pieces);
    for (size_t i = 0; pieces && i < count; i++) {
        pieces[i] = malloc(PIECE);
        if (pieces[i])
            memset(pieces[i], 1, PIECE);
    }
    for (size_t i = 0; pieces && i < count; i++)
        free(pieces[i]);
    free(pieces);
}

struct worker {
    struct queue *queue, *slower;
    struct responder *responder;
    int nice;
    struct heartbeat heartbeat;
    pthread_t thread;
};

struct pool {
    size_t most, count; /* of workers */
    struct worker workers[];
};

struct pool *pool_create(size_t most)
{
    struct pool *pool = calloc(1, sizeof *pool + most * sizeof *pool->workers);
    if (pool)
        pool->most = most;
    return pool;
}

/* Does an item, or passes it on to slower workers, which then may release the job at any time. */
static void worker_do_item(const struct worker *worker, struct job *job, size_t item)
{
    struct digest owner = job->owner;
    bool is_long = worker->slower && queue_is_long(worker->queue, job);
    enum job_end end = is_long ? JOB_LONG : job_run(job, item, worker->responder);
    if (end == JOB_LONG && !is_long)
        queue_note_long(worker->queue, owner);
    if (end == JOB_LONG)
        end = queue_demote(worker->slower, job, item);
    bool ended = end == JOB_ENDED;
    queue_done(worker->queue, owner, ended ? job : NULL);
    if (ended)
        job->kind->release(job);
}

static void *worker_run(void *argument)
{
    struct worker *worker = argument;
    struct job *job;
    size_t item;
    if (worker->nice)
        setpriority(PRIO_PROCESS, (id_t)gettid(), worker->nice);
    pthread_setname_np(pthread_self(), worker->nice ? "long" : "worker");
    heartbeat_adopt(&worker->heartbeat);
    while ((job = queue_take(worker->queue, &item))) {
        heartbeat_beat();
        worker_do_item(worker, job, item);
        heartbeat_rest();
    }
    return NULL;
}

bool pool_add(struct pool *pool, struct queue *queue, struct queue *slower,
              struct responder *responder, int nice)
{
    assert(pool->count < pool->most);
    struct worker *worker = &pool->workers[pool->count];
    *worker =
        (struct worker){.queue = queue, .slower = slower, .responder = responder, .nice = nice};
    if (pthread_create(&worker->thread, NULL, worker_run, worker) != 0) {
        responder_free(responder);
        return false;
    }
    pool->count++;
    return true;
}

double pool_silence(const struct pool *pool)
{
    double longest = 0.0, now = clock_now();
    for (size_t i = 0; i < pool->count; i++)
        longest = fmax(longest, heartbeat_silence(&pool->workers[i].heartbeat, now));
    return longest;
}

void pool_join(struct pool *pool)
{
    for (size_t i = 0; pool && i < pool->count; i++) {
        pthread_join(pool->workers[i].thread, NULL);
        responder_free(pool->workers[i].responder);
    }
    free(pool);
}
