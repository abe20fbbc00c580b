/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/store_job.h"

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

static bool clear_run(struct job *job, size_t item, struct responder *responder)
{
    const struct clear_job *clear = (const struct clear_job *)job;
    (void)item, (void)responder;
    specimen_lane_clear(clear->shared->specimens, clear->specimen);
    return true;
}

/* Has no reply: a client that sees no effect asks again. */
static void clear_refuse(struct job *job, size_t item)
{
    (void)item;
    log_line(LEVEL_WARNING, "specimen %s: not cleared: too many requests are waiting",
             ((const struct clear_job *)job)->specimen);
}

static void clear_report(struct job *job)
{
    status_announce(((const struct clear_job *)job)->shared);
}

static void clear_release(struct job *job)
{
    free(job);
}

static const struct job_kind clear_kind = {
    .run = clear_run, .refuse = clear_refuse, .report = clear_report, .release = clear_release};

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

struct backup_job {
    struct job job;
    struct shared *shared;
};

static bool backup_run(struct job *job, size_t item, struct responder *responder)
{
    struct shared *shared = ((const struct backup_job *)job)->shared;
    (void)item, (void)responder;
    specimen_lane_back_up(shared->specimens, shared->settings->backup);
    return true;
}

/* Has no reply: the administrator reads the log. */
static void backup_refuse(struct job *job, size_t item)
{
    (void)job, (void)item;
    log_line(LEVEL_WARNING, "store: not looked through: too many requests are waiting");
}

static void backup_report(struct job *job)
{
    (void)job;
}

static void backup_release(struct job *job)
{
    free(job);
}

static const struct job_kind backup_kind = {
    .run = backup_run, .refuse = backup_refuse, .report = backup_report, .release = backup_release};

struct job *backup_job_create(struct shared *shared)
{
    struct backup_job *backup = calloc(1, sizeof *backup);
    if (!backup)
        return NULL;
    backup->shared = shared;
    job_init(&backup->job, &backup_kind, 1, (struct digest){0});
    return &backup->job;
}
