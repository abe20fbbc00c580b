/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/ensemble_job.h"

#include <stdlib.h>

#include "daemon/delivery.h"
#include "daemon/ensemble_run.h"
#include "exchange/encode.h"
#include "exchange/key_map.h"
#include "exchange/question.h"

struct ensemble_job {
    struct client_job base;
    struct ensemble_entry entry;
    percuss_v1_Request *scene;           /* a copy */
    percuss_v1_EnsembleRequest *request; /* a copy of the rest, whose scene is that */
    struct answer *answer;               /* the reply; NULL: not yet, or no memory for it */
};

static bool run(struct job *job, size_t item, struct responder *responder)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    (void)item, (void)responder;
    ensemble->answer = ensemble_run(&ensemble->base, &ensemble->entry, ensemble->request);
    return true;
}

static void refuse(struct job *job, size_t item)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    struct envelope envelope = client_job_envelope(&ensemble->base);
    char message[DELIVERY_MESSAGE];
    (void)item;
    ensemble->answer = encode_ensemble_refusal(&envelope, PERCUSS_BUSY,
                                               delivery_too_many(ensemble->base.shared, message));
}

static void report(struct job *job)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    client_job_deliver(&ensemble->base, ensemble->answer);
}

static void cancel(struct job *job)
{
    atomic_store(&((struct ensemble_job *)job)->entry.cancelled, true);
}

static void release(struct job *job)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    ensembles_leave(&ensemble->base.shared->ensembles, &ensemble->entry);
    client_job_end(&ensemble->base);
    answer_release(ensemble->answer);
    free(ensemble->request);
    free(ensemble->scene);
    free(ensemble);
}

static bool describe(const struct job *job, struct task *task)
{
    return client_job_describe((const struct client_job *)job, percuss_v1_TASK_ENSEMBLE, task);
}

/* Cancelled by its client (ensembles.h) it still has a reply. */
static const struct job_kind ensemble_kind = {run, refuse, report, cancel, release, describe, NULL};

struct client_job *ensemble_job_create(struct shared *shared, const struct request_name *name,
                                       const percuss_v1_EnsembleRequest *request, double arrival)
{
    struct ensemble_job *job = calloc(1, sizeof *job);
    if (!job)
        return NULL;
    /* copies: what was taken goes back to DDS */
    job->scene = question_copy(&request->scene, 1);
    job->request = question_copy_ensemble(request);
    if (!job->scene || !job->request) {
        free(job->scene);
        free(job->request);
        free(job);
        return NULL;
    }
    job->request->scene = *job->scene;
    /* a job of its client, in a lane of their own */
    job_init(&job->base.job, &ensemble_kind, 1, digest_of_octets(name->client));
    client_job_begin(&job->base, shared, name, arrival);
    job->base.lane = LANE_ENSEMBLES;
    /* by which the client can cancel it, and is told of its turn */
    job->entry.client = job->base.client;
    job->entry.sequence = name->sequence;
    job->entry.samples = request->samples;
    ensembles_enter(&shared->ensembles, &job->entry);
    return &job->base;
}
