/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/errand.h"

#include <stdlib.h>

struct errand {
    struct job job;
    struct job *parent;
    size_t item;
    bool was_last; /* the parent has ended with it */
};

static bool run(struct job *job, size_t item, struct responder *responder)
{
    struct errand *errand = (struct errand *)job;
    (void)item;
    enum job_end end = job_run(errand->parent, errand->item, responder);
    errand->was_last = end == JOB_ENDED;
    return end != JOB_LONG;
}

static void refuse(struct job *job, size_t item)
{
    struct errand *errand = (struct errand *)job;
    (void)item;
    errand->was_last = job_refuse_item(errand->parent, errand->item) == JOB_ENDED;
}

/* The parent has reported. */
static void report(struct job *job)
{
    (void)job;
}

static void cancel(struct job *job)
{
    struct job *parent = ((struct errand *)job)->parent;
    parent->kind->cancel(parent);
}

/* Whoever cancels the errand finds its parent there till then. */
static void release(struct job *job)
{
    struct errand *errand = (struct errand *)job;
    if (errand->was_last) {
        queue_retire(errand->parent);
        errand->parent->kind->release(errand->parent);
    }
    free(errand);
}

/* Its parent is told of. */
static const struct job_kind errand_kind = {run, refuse, report, cancel, release, NULL, NULL};

enum job_end errand_send(struct job *job, size_t item, struct queue *queue)
{
    struct job *displaced = NULL;
    struct errand *errand = calloc(1, sizeof *errand);
    if (!errand)
        return job_refuse_item(job, item);
    errand->parent = job;
    errand->item = item;
    job_init(&errand->job, &errand_kind, 1, job->owner);
    /* once it is there, it and its parent may end at any time */
    bool accepted = queue_put(queue, &errand->job, &displaced);
    if (displaced)
        job_refuse(displaced);
    if (accepted)
        return JOB_GOES_ON;
    free(errand);
    return job_refuse_item(job, item);
}
