/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/ensemble_job.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "daemon/ensemble_publish.h"
#include "daemon/parallel.h"
#include "daemon/table_maker.h"
#include "endpoint/clock.h"
#include "endpoint/decode_ensemble.h"
#include "endpoint/encode.h"
#include "endpoint/encode_ensemble.h"
#include "endpoint/question.h"
#include "ensemble/create.h"
#include "ensemble/report_make.h"

enum { MOST_WORKERS = 64 };

struct ensemble_job {
    struct client_job base;
    struct ensemble_entry entry;
    percuss_v1_Request *scene;           /* a copy */
    percuss_v1_EnsembleRequest *request; /* a copy of the rest, whose scene is that */
    struct answer *answer;               /* the reply; NULL: none yet, or no memory for it */

    /* what follows is of the thread that runs it, but for what the workers are given */
    double deadline; /* monotonic, s; INFINITY: none */
    struct decoded_ensemble *decoded;
    struct ensemble ensemble;
    struct table_maker maker; /* of tables that are asked for */
    unsigned worker_count;
    struct ensemble_worker *workers[MOST_WORKERS]; /* each of one thread */
    struct ensemble_sample *samples;               /* each of the thread that solves it */
    struct ensemble_extra *extras;
    uint64_t done;
    bool in_extras;
    double noticed;          /* monotonic, s: when those who wait heard last */
    atomic_bool stopped;     /* the workers are to give up */
    enum percuss_status cut; /* what cut it short, for a reply without samples; OK: nothing */
    char message[160];       /* of that */
};

static bool is_due(const struct ensemble_job *job)
{
    return clock_now() >= job->noticed + 1.0;
}

/* Once a second. */
static void keep_waiting(struct ensemble_job *job)
{
    if (!is_due(job))
        return;
    job->noticed = clock_now();
    ensemble_publish_waiting(job->base.shared, &job->entry);
}

static void publish_progress(struct ensemble_job *job, uint64_t done)
{
    struct shared *shared = job->base.shared;
    uint64_t count = job->ensemble.count;
    struct report_progress progress = report_progress(&job->ensemble, job->samples, done, false);
    ensemble_publish_progress(shared, &job->entry, done, count, &progress);
    activity_set(&shared->activity, (double)done / (double)count, "ensemble: %llu of %llu samples",
                 (unsigned long long)done, (unsigned long long)count);
    keep_waiting(job);
}

/* Notes why there will be no more samples. */
static void __attribute__((format(printf, 3, 4)))
cut_short(struct ensemble_job *job, enum percuss_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(job->message, sizeof job->message, format, arguments);
    va_end(arguments);
    job->cut = status;
}

/* Whether anybody still wants the rest; whoever has left does not, even if he is back. */
static bool is_wanted(struct ensemble_job *job)
{
    if (client_job_is_gone(&job->base) || atomic_load(&job->base.abandoned))
        return false;
    if (atomic_load(&job->entry.cancelled))
        cut_short(job, PERCUSS_TRUNCATED, "cancelled");
    else if (clock_now() > job->deadline)
        cut_short(job, PERCUSS_TIMEOUT, "options.deadline: %g s: has passed",
                  job->scene->options.deadline);
    return job->cut == PERCUSS_OK;
}

/* While the model is chosen. */
static bool choice_goes_on(void *context, double done)
{
    struct ensemble_job *job = context;
    (void)done;
    if (is_due(job))
        ensemble_publish_progress(job->base.shared, &job->entry, 0, job->entry.samples, NULL);
    keep_waiting(job);
    return is_wanted(job);
}

/* While the workers solve: the thread that waits for them. */
static bool samples_go_on(void *context, uint64_t done)
{
    struct ensemble_job *job = context;
    publish_progress(job, job->in_extras ? job->done : done);
    atomic_store(&job->stopped, !is_wanted(job));
    return !atomic_load(&job->stopped);
}

/* Within a sample, which may take a second: what that thread has found. */
static bool sample_goes_on(void *context, double done)
{
    struct ensemble_job *job = context;
    (void)done;
    return !atomic_load(&job->stopped);
}

/* While samples are solved again for the words of the warnings. */
static bool words_go_on(void *context, double done)
{
    struct ensemble_job *job = context;
    (void)done;
    if (is_due(job))
        publish_progress(job, job->done);
    return is_wanted(job);
}

static bool work_on_sample(void *context, unsigned thread, uint64_t item)
{
    struct ensemble_job *job = context;
    ensemble_solve(job->workers[thread], item, &job->samples[item], NULL);
    return job->samples[item].status != PERCUSS_TIMEOUT;
}

static bool work_on_extra(void *context, unsigned thread, uint64_t item)
{
    struct ensemble_job *job = context;
    job->extras[item] = ensemble_extra(job->workers[thread], job->done, item);
    return sample_goes_on(job, 0.0);
}

/* From the wire to an ensemble that is ready to run. */
static enum percuss_status prepare(struct ensemble_job *job, struct fault *fault)
{
    const struct client_job *base = &job->base;
    double seconds = job->scene->options.deadline;
    job->deadline = seconds > 0.0 ? base->arrival + seconds : INFINITY;
    job->decoded = calloc(1, sizeof *job->decoded);
    if (!job->decoded)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = decode_ensemble(job->request, job->decoded, fault);
    if (status)
        return status;
    /* as for a single request: tables that are insisted on are computed when the impact as it is
     * stated is tried; no input changes a material, so that the workers only look them up */
    table_maker_init(&job->maker, base->shared, true);
    job->decoded->spec.catalogue = base->snapshot->set;
    job->decoded->spec.tables = table_maker_begin(&job->maker, base->snapshot->tables, job->scene,
                                                  base->client, base->arrival);
    job->maker.cancelled = &job->entry.cancelled;
    const struct watch watch = {choice_goes_on, job};
    status = is_wanted(job) ? ensemble_create(&job->ensemble, &job->decoded->spec, &watch, fault)
                            : PERCUSS_TIMEOUT;
    /* why it was given up */
    if (job->maker.status)
        return fault_set(fault, job->maker.status, "%s", job->maker.fault.text);
    if (job->cut)
        return fault_set(fault, PERCUSS_TIMEOUT, "%s before the first sample", job->message);
    if (status == PERCUSS_TIMEOUT && atomic_load(&base->abandoned))
        return fault_set(fault, PERCUSS_TIMEOUT, SHARED_CLIENT_GONE);
    return status;
}

/* One worker a thread, and room for the samples. */
static enum percuss_status create_workers(struct ensemble_job *job, struct fault *fault)
{
    const struct watch watch = {sample_goes_on, job};
    unsigned wanted = job->base.shared->settings->workers;
    wanted = wanted < MOST_WORKERS ? wanted : MOST_WORKERS;
    /* computing a table is for a single thread */
    table_maker_only_finds(&job->maker);
    job->samples = calloc(job->ensemble.count, sizeof *job->samples);
    if (!job->samples)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (; job->worker_count < wanted; job->worker_count++) {
        struct ensemble_worker **worker = &job->workers[job->worker_count];
        if (ensemble_worker_create(worker, &job->ensemble, &watch, fault))
            return PERCUSS_INTERNAL;
    }
    return PERCUSS_OK;
}

/* Solves samples until there are all, or enough, or nobody wants more. */
static void solve_samples(struct ensemble_job *job)
{
    bool wanted = is_wanted(job);
    while (wanted && job->done < job->ensemble.count) {
        uint64_t next = ensemble_next_check(&job->ensemble, job->done);
        struct parallel_loop loop = {job->worker_count, job->done,     next,
                                     work_on_sample,    samples_go_on, job};
        job->done = parallel_run(&loop);
        wanted = job->done == next && is_wanted(job);
        if (wanted && next < job->ensemble.count &&
            report_progress(&job->ensemble, job->samples, next, true).enough)
            break;
        if (job->done < next && !atomic_load(&job->stopped))
            cut_short(job, PERCUSS_INTERNAL, "no thread could be started");
    }
    publish_progress(job, job->done);
}

/* After an early end the extras are left out: they would take time that was not given. False: out
 * of memory. */
static bool solve_extras(struct ensemble_job *job)
{
    uint64_t count = job->cut ? 0 : ensemble_extras(&job->ensemble, job->done);
    if (count == 0)
        return true;
    job->extras = calloc(count, sizeof *job->extras);
    if (!job->extras)
        return false;
    job->in_extras = true;
    struct parallel_loop loop = {job->worker_count, 0, count, work_on_extra, samples_go_on, job};
    if (parallel_run(&loop) < count) {
        free(job->extras);
        job->extras = NULL;
    }
    return true;
}

/* The reply on what was solved. */
static struct answer *report_samples(struct ensemble_job *job, const struct envelope *envelope)
{
    const struct watch watch = {words_go_on, job};
    const struct report_material material = {job->done, job->samples, job->extras};
    struct ensemble_report results;
    bool good = report_create(&results, &job->ensemble, &material, &watch);
    /* that too may have been cut short */
    bool cut = job->cut != PERCUSS_OK;
    char message[256] = "";
    if (cut)
        snprintf(message, sizeof message, "%s: %llu of %llu samples were solved", job->message,
                 (unsigned long long)job->done, (unsigned long long)job->ensemble.count);
    struct ensemble_ending ending = {cut ? PERCUSS_TRUNCATED : PERCUSS_OK, message};
    struct answer *answer = NULL;
    if (good)
        answer = encode_ensemble(envelope, &job->ensemble, &results, &ending);
    if (answer)
        answer->passing = cut; /* asked again there may be more */
    report_release(&results);
    return answer;
}

static struct answer *refuse(const struct envelope *envelope, enum percuss_status status,
                             const char *message)
{
    struct answer *answer = encode_ensemble_refusal(envelope, status, message);
    if (answer && status == PERCUSS_TRUNCATED)
        answer->passing = true;
    return answer;
}

static struct answer *carry_out(struct ensemble_job *job, const struct envelope *envelope)
{
    struct fault fault = {""};
    enum percuss_status status = prepare(job, &fault);
    if (!status)
        status = create_workers(job, &fault);
    if (status)
        return refuse(envelope, status, fault.text);
    /* the samples, and what they say */
    publish_progress(job, 0);
    solve_samples(job);
    bool good = solve_extras(job);
    struct answer *answer = NULL;
    if (good && !atomic_load(&job->base.abandoned))
        answer =
            job->done ? report_samples(job, envelope) : refuse(envelope, job->cut, job->message);
    if (good && job->done && job->request->list_samples && !atomic_load(&job->base.abandoned))
        good = ensemble_publish_samples(job->base.shared, &job->entry, &job->ensemble, job->samples,
                                        job->done);
    if (good && !atomic_load(&job->base.abandoned))
        return answer;
    /* who has come back meanwhile hears of his leaving; nobody else does */
    answer_release(answer);
    return good ? refuse(envelope, PERCUSS_TIMEOUT, SHARED_CLIENT_GONE)
                : refuse(envelope, PERCUSS_INTERNAL, "out of memory");
}

static void run(struct job *job, size_t item, struct responder *responder)
{
    struct ensemble_job *ensemble = (struct ensemble_job *)job;
    struct envelope envelope = client_job_envelope(&ensemble->base);
    double start = clock_now();
    (void)item, (void)responder;
    struct answer *answer = carry_out(ensemble, &envelope);
    activity_clear(&ensemble->base.shared->activity);
    if (answer) {
        answer->report->timing.queue = start - ensemble->base.arrival;
        answer->report->timing.solve = clock_now() - start;
    }
    ensemble->answer = answer;
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
    for (unsigned i = 0; i < ensemble->worker_count; i++)
        ensemble_worker_free(ensemble->workers[i]);
    ensemble_release(&ensemble->ensemble);
    answer_release(ensemble->answer);
    free(ensemble->extras);
    free(ensemble->samples);
    free(ensemble->decoded);
    free(ensemble->request);
    free(ensemble->scene);
    free(ensemble);
}

static const struct job_kind ensemble_kind = {run, report, cancel, release};

struct client_job *ensemble_job_create(struct shared *shared, const struct request_name *name,
                                       const percuss_v1_EnsembleRequest *request, double arrival)
{
    struct ensemble_job *job = calloc(1, sizeof *job);
    if (!job)
        return NULL;
    job->scene = question_copy(&request->scene, 1);
    job->request = question_copy_ensemble(request);
    if (!job->scene || !job->request) {
        free(job->scene);
        free(job->request);
        free(job);
        return NULL;
    }
    job->request->scene = *job->scene;
    job_init(&job->base.job, &ensemble_kind, 1);
    client_job_begin(&job->base, shared, name, arrival);
    job->base.lane = LANE_LONG;
    job->entry.client = job->base.client;
    job->entry.sequence = name->sequence;
    job->entry.samples = request->samples;
    ensembles_enter(&shared->ensembles, &job->entry);
    return &job->base;
}
