/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/client_job.h"

#include <math.h>
#include <string.h>

#include "daemon/delivery.h"

void client_job_begin(struct client_job *job, struct shared *shared,
                      const struct request_name *name, double arrival)
{
    job->shared = shared;
    memcpy(job->client, name->client, sizeof job->client);
    job->name = (struct request_name){job->client, name->exchange, name->sequence};
    job->arrival = arrival;
    job->snapshot = snapshots_hold(&shared->snapshots);
    atomic_init(&job->abandoned, false);
    atomic_init(&job->fate, FATE_OPEN);
    atomic_init(&job->running, 0);
    atomic_init(&job->done, 0.0);
}

void client_job_end(struct client_job *job)
{
    snapshots_release(&job->shared->snapshots, job->snapshot);
}

struct envelope client_job_envelope(const struct client_job *job)
{
    return delivery_envelope(job->shared, &job->name, job->snapshot);
}

bool client_job_is_gone(struct client_job *job)
{
    bool gone = reply_store_is_gone(job->shared->replies, job->client);
    if (gone)
        atomic_store(&job->abandoned, true);
    return gone;
}

/* False: it has come to another end before. */
static bool settle(struct client_job *job, enum client_job_fate fate)
{
    int open = FATE_OPEN;
    return atomic_compare_exchange_strong(&job->fate, &open, (int)fate);
}

bool client_job_is_withdrawn(const struct client_job *job)
{
    return atomic_load(&job->fate) == FATE_WITHDRAWN;
}

bool client_job_withdraw(struct job *job, const struct request_name *name)
{
    struct client_job *ours = (struct client_job *)job;
    if (name->exchange != ours->name.exchange || name->sequence != ours->name.sequence ||
        memcmp(name->client, ours->client, sizeof ours->client) != 0 ||
        !settle(ours, FATE_WITHDRAWN))
        return false;
    reply_store_forget(ours->shared->replies, name);
    return true;
}

void client_job_deliver(struct client_job *job, struct answer *answer)
{
    if (!settle(job, FATE_DELIVERED))
        return;
    if (atomic_load(&job->abandoned) && client_job_is_gone(job))
        reply_store_forget(job->shared->replies, &job->name);
    else
        deliver(job->shared, &job->name, answer);
}

/* Of several items those that are settled count; of one, what its solve has said. */
static double share_done(const struct client_job *job)
{
    size_t items = job->job.items;
    if (items > 1)
        return (double)(items - atomic_load(&job->job.left)) / (double)items;
    double done = atomic_load(&job->done);
    return done > 0.0 ? fmin(done, 1.0) : NAN;
}

bool client_job_describe(const struct client_job *job, uint32_t kind, struct task *task)
{
    *task = (struct task){
        .sequence = job->name.sequence,
        .kind = kind,
        .running = atomic_load(&job->running) > 0,
        .arrival = job->arrival,
        .done = share_done(job),
    };
    memcpy(task->client, job->client, sizeof task->client);
    return !client_job_is_withdrawn(job);
}
