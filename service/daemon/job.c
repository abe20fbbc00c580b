/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/job.h"

#include <stdlib.h>

#include "endpoint/question.h"

struct job *job_create(enum exchange exchange, const percuss_v1_Request *requests, size_t count)
{
    struct job *job = calloc(1, sizeof *job);
    if (!job)
        return NULL;
    job->exchange = exchange;
    job->count = count;
    atomic_init(&job->left, count);
    job->requests = question_copy(requests, count);
    job->answers = calloc(count, sizeof(struct answer *));
    if (job->requests && job->answers)
        return job;
    job_free(job);
    return NULL;
}

struct job *job_create_ensemble(const percuss_v1_EnsembleRequest *request)
{
    struct job *job = job_create(EXCHANGE_ENSEMBLE, &request->scene, 1);
    if (!job)
        return NULL;
    job->ensemble = question_copy_ensemble(request);
    if (!job->ensemble) {
        job_free(job);
        return NULL;
    }
    job->ensemble->scene = job->requests[0];
    return job;
}

void job_free(struct job *job)
{
    for (size_t i = 0; job->answers && i < job->count; i++)
        answer_release(job->answers[i]);
    free(job->answers);
    free(job->requests);
    free(job->ensemble);
    free(job);
}
