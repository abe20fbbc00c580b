/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/ensemble_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "daemon/parallel.h"
#include "endpoint/clock.h"
#include "endpoint/decode_ensemble.h"
#include "endpoint/encode.h"
#include "endpoint/encode_ensemble.h"

/* Listed samples: parts of about this size, but no more of them than the writer keeps. */
enum { PART_BYTES = 64 * 1024, MOST_PARTS = 1000, PATIENCE = 20, MOST_WORKERS = 64 };

static const char client_had_gone[] = "the client had gone: ask again";

struct ensemble_run {
    struct service *service;
    struct job *job;
    double deadline; /* monotonic, s; INFINITY: none */
    struct decoded_ensemble *decoded;
    struct ensemble ensemble;
    struct table_maker maker; /* of tables that are asked for */
    unsigned worker_count;
    struct ensemble_worker *workers[MOST_WORKERS];
    struct ensemble_sample *samples;
    struct ensemble_extra *extras;
    uint64_t done;
    bool in_extras;
    double noticed;      /* monotonic, s: when those who wait were */
    atomic_bool stopped; /* the workers are to give up */
    char message[160];   /* what cut it short; empty: nothing */
};

/* Writes a progress sample to the client of a job. */
static void publish(struct service *service, const struct job *job, uint64_t done, uint64_t samples,
                    const struct report_progress *progress)
{
    percuss_v1_EnsembleProgress sample = {
        .sequence = job->sequence,
        .done = done,
        .samples = samples,
        .mean = progress->mean,
        .standard_deviation = progress->deviation,
        .half_width = progress->half_width,
    };
    memcpy(sample.client, job->client, sizeof sample.client);
    endpoint_publish(service->endpoint, job->client, CHANNEL_PROGRESS, &sample, 0);
}

static const struct report_progress no_progress = {NAN, NAN, NAN, NAN, false};

/* Who waits for another ensemble to end hears that the server is there. */
static void tell_waiting(void *context, const struct job *waiting)
{
    publish(context, waiting, 0, waiting->ensemble->samples, &no_progress);
}

/* Once a second. */
static void keep_waiting(struct ensemble_run *run)
{
    double now = clock_now();
    if (now < run->noticed + 1.0)
        return;
    run->noticed = now;
    ensembles_tell_waiting(&run->service->ensembles, run->job, tell_waiting, run->service);
}

static void publish_progress(struct ensemble_run *run, uint64_t done)
{
    struct report_progress progress = report_progress(&run->ensemble, run->samples, done, false);
    publish(run->service, run->job, done, run->ensemble.count, &progress);
    ensembles_note(&run->service->ensembles, done, run->ensemble.count);
    keep_waiting(run);
}

/* Whether anybody still wants the rest. */
static bool is_wanted(struct ensemble_run *run)
{
    struct job *job = run->job;
    if (reply_store_is_gone(run->service->replies, job->client))
        atomic_store(&job->abandoned, true);
    if (atomic_load(&job->abandoned))
        return false;
    if (atomic_load(&job->cancelled))
        snprintf(run->message, sizeof run->message, "cancelled");
    else if (clock_now() > run->deadline)
        snprintf(run->message, sizeof run->message, "options.deadline: %g s: has passed",
                 job->requests[0].options.deadline);
    return !run->message[0];
}

/* While the model is chosen. */
static bool lasts(void *context, double done)
{
    struct ensemble_run *run = context;
    (void)done;
    if (clock_now() >= run->noticed + 1.0)
        tell_waiting(run->service, run->job);
    keep_waiting(run);
    return is_wanted(run);
}

static bool watch(void *context, uint64_t done)
{
    struct ensemble_run *run = context;
    publish_progress(run, run->in_extras ? run->done : done);
    atomic_store(&run->stopped, !is_wanted(run));
    return !atomic_load(&run->stopped);
}

/* Within a sample, which may take a second: what the watch has said. */
static bool goes_on(void *context, double done)
{
    struct ensemble_run *run = context;
    (void)done;
    return !atomic_load(&run->stopped);
}

static bool work_on_sample(void *context, unsigned thread, uint64_t item)
{
    struct ensemble_run *run = context;
    ensemble_solve(run->workers[thread], item, &run->samples[item], NULL);
    return run->samples[item].status != PERCUSS_TIMEOUT;
}

static bool work_on_extra(void *context, unsigned thread, uint64_t item)
{
    struct ensemble_run *run = context;
    run->extras[item] = ensemble_extra(run->workers[thread], run->done, item);
    return goes_on(run, 0.0);
}

/* Solves samples until there are all, or enough, or nobody wants more. */
static void solve_samples(struct ensemble_run *run)
{
    bool wanted = is_wanted(run);
    while (wanted && run->done < run->ensemble.count) {
        uint64_t next = ensemble_next_check(&run->ensemble, run->done);
        struct parallel_loop loop = {run->worker_count, run->done, next,
                                     work_on_sample,    watch,     run};
        run->done = parallel_run(&loop);
        wanted = run->done == next && is_wanted(run);
        if (wanted && next < run->ensemble.count &&
            report_progress(&run->ensemble, run->samples, next, true).enough)
            break;
    }
    publish_progress(run, run->done);
}

/* After an early end the extras are left out: they would take time that was not given. */
static void solve_extras(struct ensemble_run *run)
{
    uint64_t count = run->message[0] ? 0 : ensemble_extras(&run->ensemble, run->done);
    run->extras = count ? calloc(count, sizeof *run->extras) : NULL;
    run->in_extras = true;
    struct parallel_loop loop = {run->worker_count, 0, count, work_on_extra, watch, run};
    if (run->extras && parallel_run(&loop) == count)
        return;
    free(run->extras);
    run->extras = NULL;
}

/* Writes the samples for the client to list. */
static void publish_samples(struct ensemble_run *run)
{
    size_t columns = encode_sample_columns(&run->ensemble);
    uint64_t rows = PART_BYTES / (columns * sizeof(double));
    if (rows * MOST_PARTS < run->done)
        rows = (run->done + MOST_PARTS - 1) / MOST_PARTS;
    uint64_t parts = (run->done + rows - 1) / rows;
    double *values = malloc(rows * columns * sizeof *values);
    for (uint64_t part = 0; values && part < parts; part++) {
        uint64_t first = part * rows;
        uint64_t count = run->done - first < rows ? run->done - first : rows;
        for (uint64_t i = 0; i < count; i++)
            encode_sample(&run->ensemble, first + i, &run->samples[first + i],
                          values + i * columns);
        percuss_v1_EnsembleSamples sample = {
            .sequence = run->job->sequence,
            .part = (uint32_t)part,
            .parts = (uint32_t)parts,
            .columns = (uint32_t)columns,
            .first = first,
            .rows = {._buffer = values,
                     ._length = (uint32_t)(count * columns),
                     ._maximum = (uint32_t)(count * columns)},
        };
        memcpy(sample.client, run->job->client, sizeof sample.client);
        if (endpoint_publish(run->service->endpoint, run->job->client, CHANNEL_SAMPLES, &sample,
                             PATIENCE) != DELIVERY_DONE)
            break;
    }
    free(values);
}

static struct answer *refuse(const struct envelope *envelope, enum percuss_status status,
                             const char *message)
{
    struct answer *answer = encode_ensemble_refusal(envelope, status, message);
    if (answer && status == PERCUSS_TRUNCATED)
        answer->passing = true;
    return answer;
}

/* While samples are solved again for the words of the warnings. */
static bool words_last(void *context, double done)
{
    struct ensemble_run *run = context;
    (void)done;
    if (clock_now() >= run->noticed + 1.0)
        publish_progress(run, run->done);
    return is_wanted(run);
}

/* The reply on what was solved. */
static struct answer *report(struct ensemble_run *run, const struct envelope *envelope)
{
    if (run->done == 0)
        return refuse(envelope,
                      atomic_load(&run->job->cancelled) ? PERCUSS_TRUNCATED : PERCUSS_TIMEOUT,
                      run->message[0] ? run->message : "no thread could be started");
    const struct watch watch = {words_last, run};
    const struct report_material material = {run->done, run->samples, run->extras};
    struct ensemble_report results;
    bool good = report_create(&results, &run->ensemble, &material, &watch);
    /* that too may have been cut short */
    bool cut = run->message[0];
    char message[256] = "";
    if (cut)
        snprintf(message, sizeof message, "%s: %llu of %llu samples were solved", run->message,
                 (unsigned long long)run->done, (unsigned long long)run->ensemble.count);
    struct ensemble_ending ending = {cut ? PERCUSS_TRUNCATED : PERCUSS_OK, message};
    struct answer *answer = NULL;
    if (good)
        answer = encode_ensemble(envelope, &run->ensemble, &results, &ending);
    if (answer)
        answer->passing = cut; /* asked again there may be more */
    report_release(&results);
    return answer;
}

/* One worker a thread. False: no memory. */
static bool create_workers(struct ensemble_run *run, struct fault *fault)
{
    const struct watch watch = {goes_on, run};
    unsigned wanted = run->service->settings->workers;
    wanted = wanted < MOST_WORKERS ? wanted : MOST_WORKERS;
    /* computing one is for a single thread */
    table_maker_only_finds(&run->maker);
    run->samples = calloc(run->ensemble.count, sizeof *run->samples);
    if (!run->samples) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return false;
    }
    for (; run->worker_count < wanted; run->worker_count++) {
        struct ensemble_worker **worker = &run->workers[run->worker_count];
        if (ensemble_worker_create(worker, &run->ensemble, fault))
            return false;
        ensemble_worker_watch(*worker, watch);
    }
    return true;
}

/* The same as for a single request: who leaves the choice takes the tables that are there, who
 * insists has them computed, which happens when the impact as it is stated is tried. No input
 * changes a material then: the workers only look them up. */
static const struct contact_table_source *find_tables(struct ensemble_run *run)
{
    struct table_cache *cache = &run->service->tables;
    const percuss_v1_Request *scene = &run->job->requests[0];
    table_maker_init(&run->maker, cache, true);
    if (scene->options.contact_model != PERCUSS_CONTACT_TABLE)
        return table_store_source(cache->loaded);
    const struct contact_table_source *source =
        table_maker_begin(&run->maker, scene, run->job->client, run->job->arrival);
    run->maker.cancelled = &run->job->cancelled;
    return source;
}

/* From the wire to an ensemble that is ready to run. */
static enum percuss_status prepare(struct ensemble_run *run, struct fault *fault)
{
    struct job *job = run->job;
    double seconds = job->requests[0].options.deadline;
    run->deadline = seconds > 0.0 ? job->arrival + seconds : INFINITY;
    run->decoded = calloc(1, sizeof *run->decoded);
    if (!run->decoded)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = decode_ensemble(job->ensemble, run->decoded, fault);
    if (status)
        return status;
    run->decoded->spec.catalogue = job->snapshot->set;
    run->decoded->spec.tables = find_tables(run);
    const struct watch watch = {lasts, run};
    status = is_wanted(run) ? ensemble_create(&run->ensemble, &run->decoded->spec, &watch, fault)
                            : PERCUSS_TIMEOUT;
    if (run->maker.status)
        return fault_set(fault, run->maker.status, "%s", run->maker.fault.text);
    if (run->message[0])
        return fault_set(fault, PERCUSS_TIMEOUT, "%s before the first sample", run->message);
    if (status == PERCUSS_TIMEOUT && atomic_load(&job->abandoned))
        return fault_set(fault, PERCUSS_TIMEOUT, "%s", client_had_gone);
    return status;
}

static void release(struct ensemble_run *run)
{
    ensembles_note(&run->service->ensembles, 0, 0);
    for (unsigned i = 0; i < run->worker_count; i++)
        ensemble_worker_free(run->workers[i]);
    ensemble_release(&run->ensemble);
    free(run->extras);
    free(run->samples);
    free(run->decoded);
    free(run);
}

/* Who has come back meanwhile hears of his leaving; nobody else does. */
static struct answer *carry_out(struct ensemble_run *run, const struct envelope *envelope)
{
    struct fault fault = {""};
    enum percuss_status status = prepare(run, &fault);
    if (status)
        return refuse(envelope, status, fault.text);
    if (!create_workers(run, &fault))
        return refuse(envelope, PERCUSS_INTERNAL, fault.text);
    publish_progress(run, 0);
    solve_samples(run);
    solve_extras(run);
    struct answer *answer = atomic_load(&run->job->abandoned) ? NULL : report(run, envelope);
    if (atomic_load(&run->job->abandoned)) {
        answer_release(answer);
        return refuse(envelope, PERCUSS_TIMEOUT, client_had_gone);
    }
    if (run->job->ensemble->list_samples)
        publish_samples(run);
    return answer;
}

struct answer *ensemble_respond(struct service *service, struct job *job)
{
    double start = clock_now();
    struct ensemble_run *run = calloc(1, sizeof *run);
    if (!run)
        return NULL;
    run->service = service;
    run->job = job;
    struct request_name name = {job->client, job->exchange, job->sequence};
    struct envelope envelope = service_envelope(service, &name, job->snapshot);
    struct answer *answer = carry_out(run, &envelope);
    release(run);
    if (answer) {
        answer->report->timing.queue = start - job->arrival;
        answer->report->timing.solve = clock_now() - start;
    }
    return answer;
}
