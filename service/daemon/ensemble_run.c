/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/ensemble_run.h"

#include "daemon/ensemble_publish.h"
#include "daemon/means.h"
#include "daemon/pulse.h"
#include "exchange/clock.h"
#include "respond/ensemble_answer.h"

/* Of the threads that solve the samples. */
enum { PATIENT_NICE = 10 };

struct ensemble_run {
    struct client_job *job;
    struct ensemble_entry *entry;
    double noticed; /* monotonic, s: when those who wait for their turn heard last */
};

static enum ensemble_wish wish(void *context)
{
    const struct ensemble_run *run = context;
    if (client_job_is_gone(run->job) || atomic_load(&run->job->abandoned))
        return ENSEMBLE_GONE;
    return atomic_load(&run->entry->cancelled) ? ENSEMBLE_CANCELLED : ENSEMBLE_WANTED;
}

static void publish(void *context, uint64_t done, uint64_t samples,
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

static bool list(void *context, const struct ensemble *ensemble,
                 const struct ensemble_sample *samples, uint64_t done)
{
    const struct ensemble_run *run = context;
    return ensemble_publish_samples(run->job->shared, run->entry, ensemble, samples, done);
}

/* While a table is computed. */
static enum percuss_status table_goes_on(void *context, const struct table_maker *maker,
                                         double done, struct fault *fault)
{
    const struct ensemble_run *run = context;
    if (atomic_load(&run->entry->cancelled))
        return fault_set(fault, PERCUSS_TIMEOUT,
                         "cancelled with %.0f %% of the contact table computed", 100.0 * done);
    return means_table_goes_on(run->job->shared, maker, done, fault);
}

static void table_ended(void *context, const struct table_maker *maker)
{
    const struct ensemble_run *run = context;
    means_table_ended(run->job->shared, maker);
}

struct answer *ensemble_run(struct client_job *job, struct ensemble_entry *entry,
                            const percuss_v1_EnsembleRequest *request)
{
    const struct settings *settings = job->shared->settings;
    struct ensemble_run run = {job, entry, 0.0};
    const struct ensemble_means means = {
        .snapshot = job->snapshot,
        .tables = {table_goes_on, table_ended, &run},
        .limit = settings->limit_seconds,
        .most_samples = settings->limit_samples,
        .workers = settings->workers,
        .nice = PATIENT_NICE,
        .beat = pulse_beat,
        .wish = wish,
        .progress = publish,
        .list = list,
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
