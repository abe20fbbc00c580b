/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/backup_job.h"

#include <stdlib.h>

#include "daemon/log.h"
#include "daemon/specimen_lane.h"

struct backup_job {
    struct job job;
    struct shared *shared;
};

static bool run(struct job *job, size_t item, struct responder *responder)
{
    struct shared *shared = ((const struct backup_job *)job)->shared;
    (void)item, (void)responder;
    specimen_lane_back_up(shared->specimens, shared->settings->backup);
    return true;
}

/* Whoever asked for it reads the log. */
static void refuse(struct job *job, size_t item)
{
    (void)job, (void)item;
    log_line(LEVEL_WARNING, "store: not looked through: too many requests are waiting");
}

static void report(struct job *job)
{
    (void)job;
}

static void release(struct job *job)
{
    free(job);
}

static const struct job_kind backup_kind = {
    .run = run, .refuse = refuse, .report = report, .release = release};

struct job *backup_job_create(struct shared *shared)
{
    struct backup_job *backup = calloc(1, sizeof *backup);
    if (!backup)
        return NULL;
    backup->shared = shared;
    job_init(&backup->job, &backup_kind, 1, (struct digest){0});
    return &backup->job;
}
