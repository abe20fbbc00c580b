/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/workers.h"

#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "daemon/ensemble_job.h"
#include "endpoint/batch.h"

static const int long_lane_nice = 10;

struct worker {
    struct service *service;
    enum lane lane;
    struct responder *responder;
    pthread_t thread;
};

static struct request_name job_name(const struct job *job)
{
    return (struct request_name){job->client, job->exchange, job->sequence};
}

/* The replies of a batch as one answer, in the order of its requests; NULL: no memory. */
static struct answer *assemble(const struct service *service, struct job *job)
{
    for (size_t i = 0; i < job->count; i++) {
        if (!job->answers[i])
            return NULL;
    }
    struct request_name name = job_name(job);
    struct envelope envelope = service_envelope(service, &name, job->snapshot);
    struct answer *answer = batch_answer(&envelope, job->answers, job->count);
    if (answer) {
        /* it has taken the references over */
        free(job->answers);
        job->answers = NULL;
    }
    return answer;
}

/* The last request of the job has been answered: sends the reply. */
static void finish(struct service *service, struct job *job)
{
    struct request_name name = job_name(job);
    /* a client that has come back meanwhile is told */
    if (atomic_load(&job->abandoned) && reply_store_is_gone(service->replies, job->client)) {
        reply_store_forget(service->replies, &name);
    } else if (job->exchange == EXCHANGE_BATCH) {
        struct answer *answer = assemble(service, job);
        service_deliver(service, &name, answer);
        answer_release(answer);
    } else {
        service_deliver(service, &name, job->answers[0]);
    }
    if (job->ensemble)
        ensembles_leave(&service->ensembles, job);
    snapshots_release(&service->snapshots, job->snapshot);
    job_free(job);
}

/* Who asked. */
struct asker {
    struct service *service;
    struct job *job;
};

/* Whether he still waits, see question.still_wanted. */
static enum percuss_status still_wanted(void *context, struct fault *fault)
{
    const struct asker *asker = context;
    if (atomic_load(&asker->service->ending))
        return fault_set(fault, PERCUSS_BUSY, "the server is shutting down: ask another one");
    if (!reply_store_is_gone(asker->service->replies, asker->job->client))
        return PERCUSS_OK;
    atomic_store(&asker->job->abandoned, true);
    return fault_set(fault, PERCUSS_TIMEOUT, "the client had gone: ask again");
}

/* The reply to one request. */
static struct answer *answer_one(struct worker *worker, const struct question *question)
{
    struct service *service = worker->service;
    if (worker->lane != LANE_SPECIMENS)
        return responder_answer(worker->responder, service->tokens, question);
    size_t before = specimen_lane_count(service->specimens);
    struct answer *answer =
        specimen_lane_respond(service->specimens, worker->responder, service->tokens, question);
    /* who has seen the reply finds its specimen announced */
    if (specimen_lane_count(service->specimens) != before)
        service_announce(service);
    return answer;
}

static void clear_specimen(struct service *service, struct job *job)
{
    specimen_lane_clear(service->specimens, job->clears);
    service_announce(service);
    snapshots_release(&service->snapshots, job->snapshot);
    job_free(job);
}

static void work_on(struct worker *worker, struct job *job, size_t index)
{
    struct service *service = worker->service;
    struct request_name name = job_name(job);
    name.sequence = job->requests[index].sequence;
    struct asker asker = {service, job};
    struct question question = {
        .request = &job->requests[index],
        .set = job->snapshot->set,
        .envelope = service_envelope(service, &name, job->snapshot),
        .arrival = job->arrival,
        .in_batch = job->exchange == EXCHANGE_BATCH,
        .still_wanted = still_wanted,
        .context = &asker,
    };
    job->answers[index] =
        job->ensemble ? ensemble_respond(service, job) : answer_one(worker, &question);
    if (atomic_fetch_sub(&job->left, 1) == 1)
        finish(service, job);
}

static void *work(void *argument)
{
    struct worker *worker = argument;
    struct queue *queue = worker->service->lanes[worker->lane];
    struct job *job;
    size_t index;
    if (worker->lane == LANE_LONG)
        setpriority(PRIO_PROCESS, (id_t)gettid(), long_lane_nice);
    while ((job = queue_take(queue, &index))) {
        if (job->clears[0])
            clear_specimen(worker->service, job);
        else
            work_on(worker, job, index);
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
    worker->responder = responder_create(&service->tables, worker->lane == LANE_LONG);
    if (worker->responder && pthread_create(&worker->thread, NULL, work, worker) == 0)
        return true;
    responder_free(worker->responder);
    return false;
}

bool workers_start(struct service *service)
{
    size_t count = service->settings->workers + 1 + (service->specimens ? 1 : 0);
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
        responder_free(service->workers[i].responder);
    }
    free(service->workers);
    service->workers = NULL;
    service->worker_count = 0;
}
