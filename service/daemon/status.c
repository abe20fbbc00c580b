/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/status.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "daemon/queue.h"
#include "daemon/specimen_lane.h"
#include "daemon/tasks.h"
#include "exchange/clock.h"
#include "exchange/text.h"

static uint32_t waiting(const struct shared *shared)
{
    size_t length = 0;
    for (int lane = 0; lane < LANE_COUNT; lane++)
        length += queue_length(shared->lanes[lane]);
    return (uint32_t)length;
}

void status_describe(struct shared *shared, char *text, size_t size)
{
    char activity[128], more[160] = "";
    double progress;
    activity_read(&shared->activity, activity, sizeof activity, &progress);
    if (activity[0] && isfinite(progress))
        snprintf(more, sizeof more, "; %s, %.0f %%", activity, 100.0 * progress);
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    snprintf(text, size,
             "%s: %zu bodies of catalogue %.8s; %llu answered, %llu refused, %u waiting%s",
             atomic_load(&shared->draining) ? "draining" : "ready", snapshot->set->count,
             snapshot->set->revision, atomic_load(&shared->answered), atomic_load(&shared->refused),
             waiting(shared), more);
    snapshots_release(&shared->snapshots, snapshot);
}

/* The tasks as they are told. */
static void list_tasks(struct shared *shared, percuss_v1_Task list[TASKS_LISTED],
                       percuss_v1_ServerStatus *status)
{
    struct tasks tasks;
    double now = clock_now();
    tasks_look(shared, &tasks);
    for (size_t i = 0; i < tasks.count; i++) {
        const struct task *task = &tasks.list[i];
        list[i] = (percuss_v1_Task){
            .sequence = task->sequence,
            .kind = task->kind,
            .running = task->running,
            .age = fmax(0.0, now - task->arrival),
            .done = task->done,
        };
        memcpy(list[i].client, task->client, sizeof list[i].client);
    }
    status->tasks._buffer = list;
    status->tasks._length = status->tasks._maximum = (uint32_t)tasks.count;
    status->all_tasks = tasks.all;
}

void status_announce(struct shared *shared)
{
    percuss_v1_Task tasks[TASKS_LISTED];
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    /* its numbers */
    percuss_v1_ServerStatus status = {
        .process = (uint32_t)getpid(),
        .workers = shared->settings->workers,
        .bodies = (uint32_t)snapshot->set->count,
        .queue_length = waiting(shared),
        .queue_capacity = LANE_COUNT * shared->settings->queue_capacity,
        .answered = atomic_load(&shared->answered),
        .refused = atomic_load(&shared->refused),
        .uptime = clock_now() - shared->started,
        .others = atomic_load(&shared->others),
        .specimens = shared->specimens ? (uint32_t)specimen_lane_count(shared->specimens) : 0,
    };
    /* its texts; what somebody waits for first */
    activity_read(&shared->activity, status.activity, sizeof status.activity, &status.progress);
    if (!status.activity[0])
        activity_read(&shared->reduction, status.activity, sizeof status.activity,
                      &status.progress);
    COPY_TEXT(status.version, PERCUSS_VERSION);
    COPY_TEXT(status.state, atomic_load(&shared->draining) ? "draining" : "ready");
    COPY_TEXT(status.catalogue_revision, snapshot->set->revision);
    COPY_TEXT(status.catalogue, shared->catalogue);
    snapshots_release(&shared->snapshots, snapshot);
    gethostname(status.host, sizeof status.host - 1);
    list_tasks(shared, tasks, &status);
    endpoint_announce_status(shared->endpoint, &status);
}
