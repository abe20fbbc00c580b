/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/ensemble_answer.h"

#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ensemble/create.h"
#include "ensemble/extras.h"
#include "ensemble/report.h"
#include "exchange/clock.h"
#include "exchange/decode.h"
#include "exchange/encode.h"
#include "exchange/encode_ensemble.h"
#include "exchange/question.h"
#include "respond/parallel.h"

/* From a request to an ensemble that can be solved. */

struct ensemble_prepared {
    struct decoded_ensemble *decoded;
    struct ensemble ensemble;
    struct table_maker maker; /* of tables that are asked for; only finds them afterwards */
};

/* Fills a zeroed structure, to be released after a failure too. TIMEOUT: the watch stopped it. */
static enum percuss_status ensemble_prepare(struct ensemble_prepared *prepared,
                                            const struct ensemble_means *means,
                                            const struct ensemble_question *question,
                                            const struct watch *watch, struct fault *fault)
{
    const percuss_v1_EnsembleRequest *request = question->request;
    if (request->samples > means->most_samples)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "samples: %llu: must be at most %u, as the server's limits.samples says",
                         (unsigned long long)request->samples, means->most_samples);
    prepared->decoded = calloc(1, sizeof *prepared->decoded);
    if (!prepared->decoded)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = decode_ensemble(request, prepared->decoded, fault);
    if (status)
        return status;
    /* as for a single request: tables that are insisted on are computed when the impact as it is
     * stated is tried; no input changes a material, so that the workers only look them up */
    table_maker_init(&prepared->maker, &means->tables, means->limit);
    prepared->decoded->spec.catalogue = means->snapshot->set;
    prepared->decoded->spec.tables =
        table_maker_begin(&prepared->maker, means->snapshot->tables, &request->scene,
                          question->envelope.client, question->arrival);
    status = ensemble_create(&prepared->ensemble, &prepared->decoded->spec, watch, fault);
    /* why it was given up */
    if (prepared->maker.status)
        return fault_set(fault, prepared->maker.status, "%s", prepared->maker.fault.text);
    /* only a single thread may compute a table */
    table_maker_only_finds(&prepared->maker);
    return status;
}

static void ensemble_prepared_release(struct ensemble_prepared *prepared)
{
    ensemble_release(&prepared->ensemble);
    free(prepared->decoded);
}

/* The same in all processes that solve items of this ensemble alike: a hash of the question, the
 * catalogue, the version, the model that was chosen, and the layout of an item in memory. */
static struct digest ensemble_prepared_digest(const struct ensemble_prepared *prepared,
                                              const struct ensemble_question *question)
{
    struct hasher hasher = {0};
    const struct ensemble_model *model = &prepared->ensemble.model;
    struct digest asked = question_digest_ensemble(question->request);
    hash_bytes(&hasher, &asked, sizeof asked);
    hash_text(&hasher, question->envelope.revision);
    hash_text(&hasher, question->envelope.version);
    hash_number(&hasher, prepared->ensemble.count);
    hash_number(&hasher, model->pilots);
    hash_number(&hasher, model->agreeing);
    hash_bytes(&hasher, &model->tolerance, sizeof model->tolerance);
    hash_bytes(&hasher, &model->model.cut, sizeof model->model.cut);
    hash_bytes(&hasher, &model->model.accuracy, sizeof model->model.accuracy);
    hash_number(&hasher, sizeof(struct ensemble_sample));
    hash_number(&hasher, sizeof(struct ensemble_extra));
    return hash_digest(&hasher);
}

/* A whole ensemble. */

enum { MOST_WORKERS = 64 };

/* Time between two reports of progress where others solve the samples, s. */
static const double TELLING = 0.1;

/* Of the thread that runs it, except for the members that the workers are given. */
struct ensemble_run {
    const struct ensemble_means *means;
    const struct ensemble_question *question;
    const percuss_v1_EnsembleRequest *request;
    double deadline; /* monotonic, s; INFINITY: none */
    double limit;    /* likewise: the end of the server's time for it */
    struct ensemble_prepared prepared;
    unsigned worker_count;
    struct ensemble_worker *workers[MOST_WORKERS]; /* each of one thread */
    struct ensemble_sample *samples;               /* each of the thread that solves it */
    struct ensemble_extra *extras;                 /* likewise */
    uint64_t done;
    atomic_uint moves; /* signs of life of the workers */
    unsigned seen;     /* of them */
    bool in_extras;
    bool gone;                   /* its client */
    double noticed;              /* monotonic, s: of the last report of progress */
    atomic_bool stopped;         /* the workers are to give up */
    struct ensemble_range asked; /* of others, as the next two */
    bool *taken;                 /* which of its items have arrived */
    uint64_t prefix;             /* all before this one have */
    enum percuss_status cut;     /* reason of an early end, for a reply without samples; OK: none */
    char message[160];           /* of that */
};

static void beat(const struct ensemble_run *run)
{
    if (run->means->beat)
        run->means->beat();
}

/* Once a second. */
static bool is_due(const struct ensemble_run *run)
{
    return clock_now() >= run->noticed + 1.0;
}

static void tell(struct ensemble_run *run, uint64_t done, uint64_t samples,
                 const struct report_progress *progress)
{
    run->noticed = clock_now();
    run->means->progress(run->means->context, done, samples, progress);
}

static void tell_progress(struct ensemble_run *run, uint64_t done)
{
    struct report_progress progress =
        report_progress(&run->prepared.ensemble, run->samples, done, false);
    tell(run, done, run->prepared.ensemble.count, &progress);
}

/* Notes why there will be no more samples. */
static void __attribute__((format(printf, 3, 4)))
cut_short(struct ensemble_run *run, enum percuss_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(run->message, sizeof run->message, format, arguments);
    va_end(arguments);
    run->cut = status;
}

/* Whether the client still wants the rest; one that has left does not, even if it is back. */
static bool is_wanted(struct ensemble_run *run)
{
    enum ensemble_wish wish = run->means->wish(run->means->context);
    run->gone = run->gone || wish == ENSEMBLE_GONE;
    if (run->gone)
        return false;
    if (wish == ENSEMBLE_CANCELLED)
        cut_short(run, PERCUSS_TRUNCATED, "cancelled");
    else if (clock_now() > run->deadline)
        cut_short(run, PERCUSS_TIMEOUT, "options.deadline: %g s: has passed",
                  run->request->scene.options.deadline);
    else if (clock_now() > run->limit)
        cut_short(run, PERCUSS_TIMEOUT,
                  "limits.seconds: %g s: the server's time for one request has passed",
                  run->means->limit);
    return run->cut == PERCUSS_OK;
}

/* While the model is chosen. */
static bool choice_goes_on(void *context, double done)
{
    struct ensemble_run *run = context;
    (void)done;
    beat(run);
    if (is_due(run))
        tell(run, 0, run->request->samples, NULL);
    return is_wanted(run);
}

/* While the workers solve: the thread that waits for them. */
static bool samples_go_on(void *context, uint64_t done)
{
    struct ensemble_run *run = context;
    /* the workers' progress is that of the ensemble */
    unsigned moves = atomic_load(&run->moves);
    if (moves != run->seen)
        beat(run);
    run->seen = moves;
    tell_progress(run, run->in_extras ? run->done : done);
    atomic_store(&run->stopped, !is_wanted(run));
    return !atomic_load(&run->stopped);
}

/* Within a sample, which may take a second: the decision of samples_go_on. */
static bool sample_goes_on(void *context, double done)
{
    struct ensemble_run *run = context;
    (void)done;
    atomic_fetch_add(&run->moves, 1);
    return !atomic_load(&run->stopped);
}

/* While samples are solved again for the words of the warnings. */
static bool words_go_on(void *context, double done)
{
    struct ensemble_run *run = context;
    (void)done;
    beat(run);
    if (is_due(run))
        tell_progress(run, run->done);
    return is_wanted(run);
}

static bool work_on_sample(void *context, unsigned thread, uint64_t item)
{
    struct ensemble_run *run = context;
    atomic_fetch_add(&run->moves, 1);
    ensemble_solve(run->workers[thread], item, &run->samples[item], NULL);
    return run->samples[item].status != PERCUSS_TIMEOUT;
}

static bool work_on_extra(void *context, unsigned thread, uint64_t item)
{
    struct ensemble_run *run = context;
    run->extras[item] = ensemble_extra(run->workers[thread], run->done, item);
    return sample_goes_on(run, 0.0);
}

/* From the wire to an ensemble that is ready to run. */
static enum percuss_status prepare(struct ensemble_run *run, struct fault *fault)
{
    /* the end of its time */
    double seconds = run->request->scene.options.deadline;
    run->deadline = seconds > 0.0 ? run->question->arrival + seconds : INFINITY;
    run->limit = clock_now() + run->means->limit;
    /* the ensemble, while the client wants it */
    const struct watch watch = {choice_goes_on, run};
    enum percuss_status status =
        is_wanted(run) ? ensemble_prepare(&run->prepared, run->means, run->question, &watch, fault)
                       : PERCUSS_TIMEOUT;
    /* why it was given up */
    if (run->cut)
        return fault_set(fault, PERCUSS_TIMEOUT, "%s before the first sample", run->message);
    if (status == PERCUSS_TIMEOUT && run->gone)
        return fault_set(fault, PERCUSS_TIMEOUT, ENSEMBLE_CLIENT_GONE);
    return status;
}

/* One worker a thread, unless others solve the samples, and room for those. */
static enum percuss_status create_workers(struct ensemble_run *run, struct fault *fault)
{
    const struct watch watch = {sample_goes_on, run};
    unsigned wanted = run->means->share ? 0 : run->means->workers;
    wanted = wanted < MOST_WORKERS ? wanted : MOST_WORKERS;
    run->samples = calloc(run->prepared.ensemble.count, sizeof *run->samples);
    if (!run->samples)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (; run->worker_count < wanted; run->worker_count++) {
        struct ensemble_worker **worker = &run->workers[run->worker_count];
        if (ensemble_worker_create(worker, &run->prepared.ensemble, &watch, fault))
            return PERCUSS_INTERNAL;
    }
    return PERCUSS_OK;
}

bool ensemble_asks_for(const struct ensemble_run *run, const struct ensemble_range *range)
{
    const struct ensemble_range *asked = &run->asked;
    return range->extras == asked->extras && range->done == asked->done &&
           range->first >= asked->first && range->first <= range->end && range->end <= asked->end;
}

bool ensemble_take(struct ensemble_run *run, const struct ensemble_range *range, const void *items)
{
    const struct ensemble_range *asked = &run->asked;
    uint64_t count = range->end - range->first;
    if (range->extras)
        memcpy(run->extras + range->first, items, count * sizeof *run->extras);
    else
        memcpy(run->samples + range->first, items, count * sizeof *run->samples);
    memset(run->taken + (range->first - asked->first), 1, count);
    /* from the first on */
    while (run->prefix < asked->end && run->taken[run->prefix - asked->first])
        run->prefix++;
    return clock_now() < run->noticed + TELLING || samples_go_on(run, run->prefix);
}

struct digest ensemble_run_digest(const struct ensemble_run *run)
{
    return ensemble_prepared_digest(&run->prepared, run->question);
}

/* Has others solve a range; returns the first item that has not arrived. */
static uint64_t share_out(struct ensemble_run *run, const struct ensemble_range *range)
{
    run->asked = *range;
    run->prefix = range->first;
    run->taken = calloc(range->end - range->first, 1);
    if (!run->taken) {
        cut_short(run, PERCUSS_INTERNAL, "out of memory");
        return range->first;
    }
    run->means->share(run->means->context, run, range);
    free(run->taken);
    run->taken = NULL;
    return run->prefix;
}

/* Items of a range, by others or by threads here; returns the first item that is not solved. */
static uint64_t solve_range(struct ensemble_run *run, const struct ensemble_range *range)
{
    if (run->means->share)
        return share_out(run, range);
    const struct parallel_loop loop = {
        run->worker_count, range->first,
        range->end,        range->extras ? work_on_extra : work_on_sample,
        samples_go_on,     run,
        run->means->nice};
    return parallel_run(&loop);
}

/* Solves samples until all are solved, or enough, or it must end early. */
static void solve_samples(struct ensemble_run *run)
{
    bool wanted = is_wanted(run);
    while (wanted && run->done < run->prepared.ensemble.count) {
        uint64_t next = ensemble_next_check(&run->prepared.ensemble, run->done);
        const struct ensemble_range range = {.first = run->done, .end = next};
        run->done = solve_range(run, &range);
        wanted = run->done == next && is_wanted(run);
        if (wanted && next < run->prepared.ensemble.count &&
            report_progress(&run->prepared.ensemble, run->samples, next, true).enough)
            break;
        if (run->done < next && !run->cut && !atomic_load(&run->stopped))
            cut_short(run, PERCUSS_INTERNAL,
                      run->means->share ? "samples were lost" : "no thread could be started");
    }
    tell_progress(run, run->done);
}

/* After an early end the extras are left out: they would take time that was not given. False: out
 * of memory. */
static bool solve_extras(struct ensemble_run *run)
{
    uint64_t count = run->cut ? 0 : ensemble_extras(&run->prepared.ensemble, run->done);
    if (count == 0)
        return true;
    run->extras = calloc(count, sizeof *run->extras);
    if (!run->extras)
        return false;
    run->in_extras = true;
    const struct ensemble_range range = {.extras = true, .done = run->done, .end = count};
    if (solve_range(run, &range) < count) {
        free(run->extras);
        run->extras = NULL;
    }
    return true;
}

/* The reply on the solved samples. */
static struct answer *report_samples(struct ensemble_run *run, const struct envelope *envelope)
{
    const struct watch watch = {words_go_on, run};
    const struct report_material material = {run->done, run->samples, run->extras};
    struct ensemble_report results;
    bool good = report_create(&results, &run->prepared.ensemble, &material, &watch);
    /* the report too may have been cut short */
    bool cut = run->cut != PERCUSS_OK;
    char message[256] = "";
    if (cut)
        snprintf(message, sizeof message, "%s: %llu of %llu samples were solved", run->message,
                 (unsigned long long)run->done, (unsigned long long)run->prepared.ensemble.count);
    struct ensemble_ending ending = {cut ? PERCUSS_TRUNCATED : PERCUSS_OK, message};
    struct answer *answer = NULL;
    if (good)
        answer = encode_ensemble(envelope, &run->prepared.ensemble, &results, &ending);
    if (answer)
        answer->passing = cut; /* the same request may get more samples later */
    report_release(&results);
    return answer;
}

static struct answer *ensemble_answer_refuse(const struct envelope *envelope,
                                             enum percuss_status status, const char *message)
{
    struct answer *answer = encode_ensemble_refusal(envelope, status, message);
    if (answer && status == PERCUSS_TRUNCATED)
        answer->passing = true;
    return answer;
}

static struct answer *carry_out(struct ensemble_run *run)
{
    const struct envelope *envelope = &run->question->envelope;
    struct fault fault = {""};
    /* the model that all samples share, and the workers */
    enum percuss_status status = prepare(run, &fault);
    if (!status)
        status = create_workers(run, &fault);
    if (status)
        return ensemble_answer_refuse(envelope, status, fault.text);
    /* the samples, and the reply on them */
    tell_progress(run, 0);
    solve_samples(run);
    bool good = solve_extras(run);
    struct answer *answer = NULL;
    if (good && !run->gone)
        answer = run->done ? report_samples(run, envelope)
                           : ensemble_answer_refuse(envelope, run->cut, run->message);
    if (good && run->done && run->request->list_samples && !run->gone)
        good =
            run->means->list(run->means->context, &run->prepared.ensemble, run->samples, run->done);
    if (good && !run->gone)
        return answer;
    /* a client that has come back meanwhile gets the refusal */
    answer_release(answer);
    return good ? ensemble_answer_refuse(envelope, PERCUSS_TIMEOUT, ENSEMBLE_CLIENT_GONE)
                : ensemble_answer_refuse(envelope, PERCUSS_INTERNAL, "out of memory");
}

static void release(struct ensemble_run *run)
{
    for (unsigned i = 0; i < run->worker_count; i++)
        ensemble_worker_free(run->workers[i]);
    ensemble_prepared_release(&run->prepared);
    free(run->extras);
    free(run->samples);
    free(run);
}

struct answer *ensemble_answer(const struct ensemble_means *means,
                               const struct ensemble_question *question)
{
    double start = clock_now();
    struct ensemble_run *run = calloc(1, sizeof *run);
    if (!run)
        return NULL;
    run->means = means;
    run->question = question;
    run->request = question->request;
    struct answer *answer = carry_out(run);
    release(run);
    /* its times of waiting and solving */
    if (answer) {
        answer->report->timing.queue = start - question->arrival;
        answer->report->timing.solve = clock_now() - start;
    }
    return answer;
}

/* Items of one, for others. */

struct ensemble_part {
    const struct ensemble_question *question;
    struct ensemble_prepared prepared;
    struct ensemble_worker *worker;
};

enum percuss_status ensemble_part_create(const struct ensemble_means *means,
                                         const struct ensemble_question *question,
                                         struct ensemble_part **part, struct fault *fault)
{
    struct ensemble_part *created = calloc(1, sizeof *created);
    *part = NULL;
    if (!created)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    created->question = question;
    enum percuss_status status = ensemble_prepare(&created->prepared, means, question, NULL, fault);
    if (!status)
        status = ensemble_worker_create(&created->worker, &created->prepared.ensemble, NULL, fault);
    if (status)
        ensemble_part_free(created);
    else
        *part = created;
    return status;
}

void ensemble_part_free(struct ensemble_part *part)
{
    if (!part)
        return;
    ensemble_worker_free(part->worker);
    ensemble_prepared_release(&part->prepared);
    free(part);
}

struct digest ensemble_part_digest(const struct ensemble_part *part)
{
    return ensemble_prepared_digest(&part->prepared, part->question);
}

uint64_t ensemble_part_items(const struct ensemble_part *part, bool extras, uint64_t done)
{
    const struct ensemble *ensemble = &part->prepared.ensemble;
    if (!extras)
        return ensemble->count;
    return done > 0 && done <= ensemble->count ? ensemble_extras(ensemble, done) : 0;
}

void ensemble_part_solve(struct ensemble_part *part, const struct ensemble_range *range,
                         void *items)
{
    struct ensemble_sample *samples = items;
    struct ensemble_extra *extras = items;
    for (uint64_t i = range->first; i < range->end; i++) {
        if (range->extras)
            extras[i - range->first] = ensemble_extra(part->worker, range->done, i);
        else
            ensemble_solve(part->worker, i, &samples[i - range->first], NULL);
    }
}
