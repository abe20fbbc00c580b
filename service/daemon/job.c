/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/job.h"

void job_init(struct job *job, const struct job_kind *kind, size_t items)
{
    job->kind = kind;
    job->items = items;
    job->next = 0;
    atomic_init(&job->left, items);
}

bool job_run(struct job *job, size_t item, struct responder *responder)
{
    job->kind->run(job, item, responder);
    if (atomic_fetch_sub(&job->left, 1) > 1)
        return false;
    job->kind->report(job);
    return true;
}
