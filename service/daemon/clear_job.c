/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/clear_job.h"

#include <stdlib.h>

#include "daemon/log.h"
#include "daemon/specimen_lane.h"
#include "daemon/status.h"
#include "exchange/text.h"

struct clear_job {
    struct job job;
    struct shared *shared;
    char specimen[PERCUSS_ID_SIZE];
};

static bool run(struct job *job, size_t item, struct responder *responder)
{
    const struct clear_job *clear = (const struct clear_job *)job;
    (void)item, (void)responder;
    specimen_lane_clear(clear->shared->specimens, clear->specimen);
    return true;
}

/* Nobody waits for an answer: a client that sees no effect asks again. */
static void refuse(struct job *job, size_t item)
{
    (void)item;
    log_line(LEVEL_WARNING, "specimen %s: not cleared: too many requests are waiting",
             ((const struct clear_job *)job)->specimen);
}

static void report(struct job *job)
{
    status_announce(((const struct clear_job *)job)->shared);
}

static void release(struct job *job)
{
    free(job);
}

static const struct job_kind clear_kind = {
    .run = run, .refuse = refuse, .report = report, .release = release};

struct job *clear_job_create(struct shared *shared, const char *specimen)
{
    struct clear_job *clear = calloc(1, sizeof *clear);
    if (!clear)
        return NULL;
    clear->shared = shared;
    COPY_TEXT(clear->specimen, specimen);
    job_init(&clear->job, &clear_kind, 1, (struct digest){0});
    return &clear->job;
}
