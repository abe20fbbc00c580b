/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/task.h"

#include <stdlib.h>

#include "endpoint/question.h"

struct task *task_create(enum exchange exchange, const percuss_v1_Request *requests, size_t count)
{
    struct task *task = calloc(1, sizeof *task);
    if (!task)
        return NULL;
    task->exchange = exchange;
    task->count = count;
    atomic_init(&task->left, count);
    task->requests = question_copy(requests, count);
    task->answers = calloc(count, sizeof(struct answer *));
    if (task->requests && task->answers)
        return task;
    task_free(task);
    return NULL;
}

struct task *task_create_ensemble(const percuss_v1_EnsembleRequest *request)
{
    struct task *task = task_create(EXCHANGE_ENSEMBLE, &request->scene, 1);
    if (!task)
        return NULL;
    task->ensemble = question_copy_ensemble(request);
    if (!task->ensemble) {
        task_free(task);
        return NULL;
    }
    task->ensemble->scene = task->requests[0];
    return task;
}

void task_free(struct task *task)
{
    for (size_t i = 0; task->answers && i < task->count; i++)
        answer_release(task->answers[i]);
    free(task->answers);
    free(task->requests);
    free(task->ensemble);
    free(task);
}
