/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/job.h"

void job_init(struct job *job, const struct job_kind *kind, size_t items, struct digest owner)
{
    job->kind = kind;
    job->items = items;
    job->owner = owner;
    job->next = 0;
    atomic_init(&job->left, items);
}

/* An item is settled. */
static enum job_end settle(struct job *job)
{
    if (atomic_fetch_sub(&job->left, 1) > 1)
        return JOB_GOES_ON;
    job->kind->report(job);
    return JOB_ENDED;
}

enum job_end job_run(struct job *job, size_t item, struct responder *responder)
{
    return job->kind->run(job, item, responder) ? settle(job) : JOB_LONG;
}

enum job_end job_refuse_item(struct job *job, size_t item)
{
    job->kind->refuse(job, item);
    return settle(job);
}

void job_refuse(struct job *job)
{
    for (size_t i = 0; i < job->items; i++)
        job_refuse_item(job, i);
    job->kind->release(job);
}
