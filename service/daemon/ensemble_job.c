/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/ensemble_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "daemon/delivery.h"
#include "daemon/pool.h"
#include "ensemble/report.h"
#include "exchange/clock.h"
#include "exchange/encode.h"
#include "exchange/encode_ensemble.h"
#include "exchange/key_map.h"
#include "exchange/question.h"
#include "respond/ensemble_answer.h"

/* Listed samples: parts of about this size, but no more of them than the writer keeps; writing one
 * may take PATIENCE tenths of a second. */
enum { PART_BYTES = 64 * 1024, MOST_PARTS = 1000, PATIENCE = 20 };

static void ensemble_publish_progress(struct shared *shared, const struct ensemble_entry *entry,
                                      uint64_t done, uint64_t samples,
                                      const struct report_progress *progress)
{
    percuss_v1_EnsembleProgress sample = {
        .sequence = entry->sequence,
        .done = done,
        .samples = samples,
        .mean = progress ? progress->mean : NAN,
        .standard_deviation = progress ? progress->deviation : NAN,
        .half_width = progress ? progress->half_width : NAN,
    };
    memcpy(sample.client, entry->client, sizeof sample.client);
    endpoint_publish(shared->endpoint, entry->client, CHANNEL_PROGRESS, &sample, 0);
}

static void ensemble_publish_to_waiting(void *context, const struct ensemble_entry *waiting)
{
    ensemble_publish_progress(context, waiting, 0, waiting->samples, NULL);
}

static void ensemble_publish_waiting(struct shared *shared)
{
    ensembles_visit_waiting(&shared->ensembles, ensemble_publish_to_waiting, shared);
}

static bool ensemble_publish_samples(struct shared *shared, const struct ensemble_entry *entry,
                                     const struct ensemble *ensemble,
                                     const struct ensemble_sample *samples, uint64_t done)
{
    /* rows in a part */
    size_t columns = encode_sample_columns(ensemble);
    uint64_t rows = PART_BYTES / (columns * sizeof(double));
    if (rows * MOST_PARTS < done)
        rows = (done + MOST_PARTS - 1) / MOST_PARTS;
    uint64_t parts = (done + rows - 1) / rows;
    double *values = malloc(rows * columns * sizeof *values);
    if (!values)
        return false;
    /* the parts, until the client takes no more */
    enum delivery delivery = DELIVERY_DONE;
    for (uint64_t part = 0; delivery == DELIVERY_DONE && part < parts; part++) {
        uint64_t first = part * rows;
        uint64_t count = done - first < rows ? done - first : rows;
        for (uint64_t i = 0; i < count; i++)
            encode_sample(ensemble, first + i, &samples[first + i], values + i * columns);
        percuss_v1_EnsembleSamples sample = {
            .sequence = entry->sequence,
            .part = (uint32_t)part,
            .parts = (uint32_t)parts,
            .columns = (uint32_t)columns,
            .first = first,
            .rows = {._buffer = values,
                     ._length = (uint32_t)(count * columns),
                     ._maximum = (uint32_t)(count * columns)},
        };
        memcpy(sample.client, entry->client, sizeof sample.client);
        delivery =
            endpoint_publish(shared->endpoint, entry->client, CHANNEL_SAMPLES, &sample, PATIENCE);
    }
    free(values);
    return true;
}

struct ensemble_run {
    struct client_job *job;
    struct ensemble_entry *entry;
    double noticed; /* time of the last message to waiting ensembles; monotonic, s */
};

static enum ensemble_wish ensemble_asks(void *context)
{
    const struct ensemble_run *run = context;
    if (client_job_is_gone(run->job) || atomic_load(&run->job->abandoned))
        return ENSEMBLE_GONE;
    return atomic_load(&run->entry->cancelled) ? ENSEMBLE_CANCELLED : ENSEMBLE_WANTED;
}

static void ensemble_note_progress(void *context, uint64_t done, uint64_t samples,
                                   const struct report_progress *progress)
{
    struct ensemble_run *run = context;
    struct shared *shared = run->job->shared;
    atomic_store(&run->job->done, (double)done / (double)samples);
    ensemble_publish_progress(shared, run->entry, done, samples, progress);
    if (progress)
        activity_set(&shared->activity, run, (double)done / (double)samples,
                     "ensemble: %llu of %llu samples", (unsigned long long)done,
                     (unsigned long long)samples);
    /* once a second */
    if (clock_now() < run->noticed + 1.0)
        return;
    run->noticed = clock_now();
    ensemble_publish_waiting(shared);
}

static bool ensemble_list(void *context, const struct ensemble *ensemble,
                          const struct ensemble_sample *samples, uint64_t done)
{
    const struct ensemble_run *run = context;
    return ensemble_publish_samples(run->job->shared, run->entry, ensemble, samples, done);
}

/* While a table is computed. */
static enum percuss_status ensemble_table_goes_on(void *context, const struct table_maker *maker,
                                                  double done, struct fault *fault)
{
    const struct ensemble_run *run = context;
    if (atomic_load(&run->entry->cancelled))
        return fault_set(fault, PERCUSS_TIMEOUT,
                         "cancelled with %.0f %% of the contact table computed", 100.0 * done);
    return shared_table_goes_on(run->job->shared, maker, done, fault);
}

static void ensemble_table_ended(void *context, const struct table_maker *maker)
{
    const struct ensemble_run *run = context;
    shared_table_ended(run->job->shared, maker);
}

static struct answer *ensemble_run(struct client_job *job, struct ensemble_entry *entry,
                                   const percuss_v1_EnsembleRequest *request)
{
    const struct settings *settings = job->shared->settings;
    struct ensemble_run run = {job, entry, 0.0};
    const struct ensemble_means means = {
        .snapshot = job->snapshot,
        .tables = {ensemble_table_goes_on, ensemble_table_ended, &run},
        .limit = settings->limit_seconds,
        .most_samples = settings->limit_samples,
        .workers = settings->workers,
        .nice = POOL_PATIENT_NICE,
        .beat = heartbeat_beat,
        .wish = ensemble_asks,
        .progress = ensemble_note_progress,
        .list = ensemble_list,
        .context = &run,
    };
    const struct ensemble_question question = {request, client_job_envelope(job), job->arrival};
    atomic_store(&entry->running, true);
    atomic_fetch_add(&job->running, 1);
    struct answer *answer = ensemble_answer(&means, &question);
    atomic_fetch_sub(&job->running, 1);
    activity_clear(&job->shared->activity, &run);
    return answer;
}

struct ensemble_job {
    struct client_job base;
    struct ensemble_entry entry;
    percuss_v1_Request *scene;           /* a copy */
    percuss_v1_EnsembleRequest *request; /* a copy of the rest, with that scene */
    struct answer *answer;               /* the reply; NULL: not yet, or no memory for it */
};

static bool ensemble_job_run(struct job *job, size_t item, struct responder *responder)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    (void)item, (void)responder;
    ensemble->answer = ensemble_run(&ensemble->base, &ensemble->entry, ensemble->request);
    return true;
}

static void ensemble_job_refuse(struct job *job, size_t item)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    struct envelope envelope = client_job_envelope(&ensemble->base);
    char message[DELIVERY_MESSAGE];
    (void)item;
    ensemble->answer = encode_ensemble_refusal(&envelope, PERCUSS_BUSY,
                                               delivery_too_many(ensemble->base.shared, message));
}

static void ensemble_job_report(struct job *job)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    client_job_deliver(&ensemble->base, ensemble->answer);
}

static void ensemble_job_cancel(struct job *job)
{
    atomic_store(&((struct ensemble_job *)job)->entry.cancelled, true);
}

static void ensemble_job_release(struct job *job)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    ensembles_leave(&ensemble->base.shared->ensembles, &ensemble->entry);
    client_job_end(&ensemble->base);
    answer_release(ensemble->answer);
    free(ensemble->request);
    free(ensemble->scene);
    free(ensemble);
}

static bool ensemble_job_describe(const struct job *job, struct task *task)
{
    return client_job_describe((const struct client_job *)job, percuss_v1_TASK_ENSEMBLE, task);
}

/* Without `withdraw`: an ensemble that its client cancels still has a reply. */
static const struct job_kind ensemble_kind = {ensemble_job_run,
                                              ensemble_job_refuse,
                                              ensemble_job_report,
                                              ensemble_job_cancel,
                                              ensemble_job_release,
                                              ensemble_job_describe,
                                              NULL};

struct client_job *ensemble_job_create(struct shared *shared, const struct request_name *name,
                                       const percuss_v1_EnsembleRequest *request, double arrival)
{
    struct ensemble_job *job = calloc(1, sizeof *job);
    if (!job)
        return NULL;
    /* copies: the sample goes back to DDS */
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
    /* the entry by which the client cancels it, and gets messages while it waits */
    job->entry.client = job->base.client;
    job->entry.sequence = name->sequence;
    job->entry.samples = request->samples;
    ensembles_enter(&shared->ensembles, &job->entry);
    return &job->base;
}
