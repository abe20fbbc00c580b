/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/tasks.h"

#include <math.h>
#include <string.h>

#include "daemon/queue.h"

/* Whether a task stands before another one. */
static bool precedes(const struct task *task, const struct task *other)
{
    return task->running != other->running ? task->running : task->arrival < other->arrival;
}

/* Puts it in its place, as long as there is one. */
static void insert(struct tasks *tasks, const struct task *task)
{
    size_t place = tasks->count;
    while (place > 0 && precedes(task, &tasks->list[place - 1]))
        place--;
    tasks->all++;
    if (place == TASKS_LISTED)
        return;
    tasks->count += tasks->count < TASKS_LISTED;
    memmove(&tasks->list[place + 1], &tasks->list[place],
            (tasks->count - place - 1) * sizeof *tasks->list);
    tasks->list[place] = *task;
}

struct visit {
    struct shared *shared;
    struct tasks *tasks;
};

static void note(void *context, const struct job *job)
{
    struct visit *visit = context;
    struct task task;
    if (!job->kind->describe || !job->kind->describe(job, &task))
        return;
    if (task.running || !reply_store_is_gone(visit->shared->replies, task.client))
        insert(visit->tasks, &task);
}

/* A mesh is reduced by another process. */
static void note_reduction(struct shared *shared, struct tasks *tasks)
{
    struct task task = {.kind = percuss_v1_TASK_MESH, .running = true};
    char text[8];
    activity_read(&shared->reduction, text, sizeof text, &task.done);
    task.arrival = activity_begun(&shared->reduction);
    if (!isnan(task.arrival))
        insert(tasks, &task);
}

void tasks_look(struct shared *shared, struct tasks *tasks)
{
    struct visit visit = {shared, tasks};
    tasks->count = 0;
    tasks->all = 0;
    note_reduction(shared, tasks);
    for (int lane = 0; lane < LANE_COUNT; lane++)
        queue_visit(shared->lanes[lane], note, &visit);
}
