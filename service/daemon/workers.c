/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/workers.h"

#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "daemon/ensemble_run.h"
#include "endpoint/batch.h"

static const int long_lane_nice = 10;

struct worker {
    struct service *service;
    enum lane lane;
    struct seat *seat;
    pthread_t thread;
};

static struct request_name task_name(const struct task *task)
{
    return (struct request_name){task->client, task->exchange, task->sequence};
}

/* The replies of a batch as one answer, in the order of its requests; NULL: no memory. */
static struct answer *assemble(const struct service *service, struct task *task)
{
    for (size_t i = 0; i < task->count; i++) {
        if (!task->answers[i])
            return NULL;
    }
    struct request_name name = task_name(task);
    struct envelope envelope = service_envelope(service, &name, task->edition);
    struct answer *answer = batch_answer(&envelope, task->answers, task->count);
    if (answer) {
        /* it has taken the references over */
        free(task->answers);
        task->answers = NULL;
    }
    return answer;
}

/* The last request of the task has been answered: sends the reply. */
static void finish(struct service *service, struct task *task)
{
    struct request_name name = task_name(task);
    /* a client that has come back meanwhile is told */
    if (atomic_load(&task->abandoned) && reply_store_is_gone(service->replies, task->client)) {
        reply_store_forget(service->replies, &name);
    } else if (task->exchange == EXCHANGE_BATCH) {
        struct answer *answer = assemble(service, task);
        service_deliver(service, &name, answer);
        answer_release(answer);
    } else {
        service_deliver(service, &name, task->answers[0]);
    }
    if (task->ensemble)
        ensembles_leave(&service->ensembles, task);
    editions_let_go(&service->editions, task->edition);
    task_free(task);
}

/* Who asked. */
struct asker {
    struct service *service;
    struct task *task;
};

/* Whether he still waits, see question.still_wanted. */
static enum percuss_status still_wanted(void *context, struct fault *fault)
{
    const struct asker *asker = context;
    if (atomic_load(&asker->service->ending))
        return fault_set(fault, PERCUSS_BUSY, "the server is shutting down: ask another one");
    if (!reply_store_is_gone(asker->service->replies, asker->task->client))
        return PERCUSS_OK;
    atomic_store(&asker->task->abandoned, true);
    return fault_set(fault, PERCUSS_TIMEOUT, "the client had gone: ask again");
}

/* The reply to one request. */
static struct answer *answer_one(struct worker *worker, const struct question *question)
{
    struct service *service = worker->service;
    if (worker->lane != LANE_SPECIMENS)
        return respond(worker->seat, service->tokens, question);
    size_t before = rig_count(service->rig);
    struct answer *answer = rig_respond(service->rig, worker->seat, service->tokens, question);
    /* who has seen the reply finds its specimen announced */
    if (rig_count(service->rig) != before)
        service_announce(service);
    return answer;
}

static void clear_specimen(struct service *service, struct task *task)
{
    rig_clear(service->rig, task->clears);
    service_announce(service);
    editions_let_go(&service->editions, task->edition);
    task_free(task);
}

static void work_on(struct worker *worker, struct task *task, size_t index)
{
    struct service *service = worker->service;
    struct request_name name = task_name(task);
    name.sequence = task->requests[index].sequence;
    struct asker asker = {service, task};
    struct question question = {
        .request = &task->requests[index],
        .set = task->edition->set,
        .envelope = service_envelope(service, &name, task->edition),
        .arrival = task->arrival,
        .in_batch = task->exchange == EXCHANGE_BATCH,
        .still_wanted = still_wanted,
        .context = &asker,
    };
    task->answers[index] =
        task->ensemble ? ensemble_respond(service, task) : answer_one(worker, &question);
    if (atomic_fetch_sub(&task->left, 1) == 1)
        finish(service, task);
}

static void *work(void *argument)
{
    struct worker *worker = argument;
    struct queue *queue = worker->service->lanes[worker->lane];
    struct task *task;
    size_t index;
    if (worker->lane == LANE_LONG)
        setpriority(PRIO_PROCESS, (id_t)gettid(), long_lane_nice);
    while ((task = queue_take(queue, &index))) {
        if (task->clears[0])
            clear_specimen(worker->service, task);
        else
            work_on(worker, task, index);
        queue_done(queue);
    }
    return NULL;
}

static enum lane lane_of(const struct service *service, size_t worker)
{
    size_t workers = service->settings->workers;
    return worker < workers ? LANE_SHORT : worker == workers ? LANE_LONG : LANE_SPECIMENS;
}

static bool worker_start(struct worker *worker, struct service *service)
{
    worker->service = service;
    worker->lane = lane_of(service, service->worker_count);
    worker->seat = seat_create(&service->tables, worker->lane == LANE_LONG);
    if (worker->seat && pthread_create(&worker->thread, NULL, work, worker) == 0)
        return true;
    seat_free(worker->seat);
    return false;
}

bool workers_start(struct service *service)
{
    size_t count = service->settings->workers + 1 + (service->rig ? 1 : 0);
    service->workers = calloc(count, sizeof *service->workers);
    while (service->workers && service->worker_count < count &&
           worker_start(&service->workers[service->worker_count], service))
        service->worker_count++;
    return service->worker_count == count;
}

void workers_join(struct service *service)
{
    for (size_t i = 0; i < service->worker_count; i++) {
        pthread_join(service->workers[i].thread, NULL);
        seat_free(service->workers[i].seat);
    }
    free(service->workers);
    service->workers = NULL;
    service->worker_count = 0;
}
