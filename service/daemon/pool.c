/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/pool.h"

#include <assert.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "daemon/errand.h"
#include "daemon/pulse.h"
#include "exchange/clock.h"
#include "respond/responder.h"

struct worker {
    struct queue *queue, *slower;
    struct responder *responder;
    int nice;
    struct pulse pulse;
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

/* Does an item, or has it done by slower workers; who then may release the job at any time. */
static void do_item(const struct worker *worker, struct job *job, size_t item)
{
    struct digest owner = job->owner;
    bool is_long = worker->slower && queue_is_long(worker->queue, job);
    enum job_end end = is_long ? JOB_LONG : job_run(job, item, worker->responder);
    if (end == JOB_LONG && !is_long)
        queue_note_long(worker->queue, owner);
    if (end == JOB_LONG)
        end = errand_send(job, item, worker->slower);
    bool ended = end == JOB_ENDED;
    queue_done(worker->queue, owner, ended ? job : NULL);
    if (ended)
        job->kind->release(job);
}

static void *work(void *argument)
{
    struct worker *worker = argument;
    struct job *job;
    size_t item;
    if (worker->nice)
        setpriority(PRIO_PROCESS, (id_t)gettid(), worker->nice);
    pthread_setname_np(pthread_self(), worker->nice ? "long" : "worker");
    pulse_adopt(&worker->pulse);
    while ((job = queue_take(worker->queue, &item))) {
        pulse_beat();
        do_item(worker, job, item);
        pulse_rest();
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
    if (pthread_create(&worker->thread, NULL, work, worker) != 0) {
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
        longest = fmax(longest, pulse_silence(&pool->workers[i].pulse, now));
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
