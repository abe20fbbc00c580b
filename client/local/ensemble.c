/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble: its samples solved by threads that end with it or shared between processes, and
 * reported. */

#include <math.h>
#include <percuss/ensemble_share.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "ensemble/extras.h"
#include "error.h"
#include "exchange/encode_ensemble.h"
#include "instance.h"
#include "library.h"
#include "moment.h"
#include "respond/ensemble_answer.h"

/* Parts of ensembles as octets, between processes. */

/* The head of a part; its items follow, as they lie in memory. */
struct part_head {
    char kind[8]; /* tells it from anything else, and machines of another byte order apart */
    struct digest ensemble;
    uint64_t first, count, done;
    uint64_t extras; /* 0 or 1 */
    struct digest seal;
};

static const char KIND[8] = {'p', 'e', 'r', 'c', 'u', 's', 's', 1};

struct percuss_ensemble_sharing {
    struct ensemble_run *run;
    struct digest digest;
};

struct percuss_ensemble_worker {
    struct percuss_client *client;
    struct ensemble_storage *storage;
    percuss_v1_EnsembleRequest wire;
    struct ensemble_means means;
    struct ensemble_question question;
    struct ensemble_part *part;
    struct digest digest;
};

/* INVALID_ARGUMENT: another library's client, which does not solve here. */
static enum percuss_result sharing_check(const struct percuss_client *client)
{
    if (client->operations == &LIBRARY_OPERATIONS)
        return PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                     "client: it asks a server: one of percuss_local_open is needed");
}

static size_t item_size(bool extras)
{
    return extras ? sizeof(struct ensemble_extra) : sizeof(struct ensemble_sample);
}

size_t percuss_ensemble_part_size(const struct percuss_ensemble_range *range)
{
    if (ERROR_NULL(range))
        return 0;
    return sizeof(struct part_head) + range->count * item_size(range->extras);
}

static enum percuss_status part_table_is_wanted(void *context, const struct table_maker *maker,
                                                double done, struct fault *fault)
{
    (void)context, (void)maker, (void)done, (void)fault;
    return PERCUSS_OK;
}

/* Chooses the model; the error of a refusal. */
static enum percuss_result prepare(struct percuss_ensemble_worker *worker)
{
    struct percuss_client *client = worker->client;
    struct fault fault;
    worker->means = (struct ensemble_means){
        .snapshot = client->snapshot,
        .tables = {.goes_on = part_table_is_wanted},
        .limit = client->settings.limit_seconds,
        .most_samples = client->settings.limit_samples,
    };
    worker->question = (struct ensemble_question){
        .request = &worker->wire,
        .envelope = {worker->wire.client, INSTANCE_SERVER, 0, client->snapshot->set->revision,
                     PERCUSS_VERSION},
        .arrival = moment_now(),
    };
    enum percuss_status status =
        ensemble_part_create(&worker->means, &worker->question, &worker->part, &fault);
    if (status == PERCUSS_OK) {
        worker->digest = ensemble_part_digest(worker->part);
        return PERCUSS_RESULT_OK;
    }
    return error_set(status == PERCUSS_INTERNAL ? PERCUSS_RESULT_NO_MEMORY
                                                : PERCUSS_RESULT_INVALID_ARGUMENT,
                     "%s", fault.text);
}

enum percuss_result percuss_ensemble_worker_create(struct percuss_client *client,
                                                   const struct percuss_ensemble_request *request,
                                                   struct percuss_ensemble_worker **worker)
{
    if (worker)
        *worker = NULL;
    enum percuss_result result = ERROR_NULL(client, request, worker);
    if (result == PERCUSS_RESULT_OK)
        result = sharing_check(client);
    if (result != PERCUSS_RESULT_OK)
        return result;
    struct percuss_ensemble_worker *created = calloc(1, sizeof *created);
    if (!created)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a worker");
    created->client = client;
    created->storage = malloc(sizeof *created->storage);
    result = created->storage ? convert_ensemble_request(request, created->storage, &created->wire)
                              : error_set(PERCUSS_RESULT_NO_MEMORY, "a worker");
    if (result == PERCUSS_RESULT_OK)
        result = prepare(created);
    if (result == PERCUSS_RESULT_OK)
        *worker = created;
    else
        percuss_ensemble_worker_free(created);
    return result;
}

void percuss_ensemble_worker_free(struct percuss_ensemble_worker *worker)
{
    if (!worker)
        return;
    ensemble_part_free(worker->part);
    free(worker->storage);
    free(worker);
}

/* Of all octets of a part: samples that were damaged on their way look like any others. */
static struct digest seal_part(const struct part_head *head, const void *items, size_t size)
{
    struct hasher hasher = {0};
    struct part_head unsealed = *head;
    unsealed.seal = (struct digest){0};
    hash_bytes(&hasher, &unsealed, sizeof unsealed);
    hash_bytes(&hasher, items, size);
    return hash_digest(&hasher);
}

enum percuss_result percuss_ensemble_worker_solve(struct percuss_ensemble_worker *worker,
                                                  const struct percuss_ensemble_range *range,
                                                  void *part)
{
    if (ERROR_NULL(worker, range, part))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    uint64_t items = ensemble_part_items(worker->part, range->extras, range->done);
    if (range->first > items || range->count > items - range->first)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "range: %llu from %llu on: the ensemble has %llu %s",
                         (unsigned long long)range->count, (unsigned long long)range->first,
                         (unsigned long long)items, range->extras ? "extras" : "samples");
    struct part_head head = {.ensemble = worker->digest,
                             .first = range->first,
                             .count = range->count,
                             .done = range->done,
                             .extras = range->extras};
    const struct ensemble_range asked = {range->extras, range->done, range->first,
                                         range->first + range->count};
    memcpy(head.kind, KIND, sizeof head.kind);
    /* bytes between members are written, too */
    size_t size = percuss_ensemble_part_size(range);
    char *solved = (char *)part + sizeof head;
    memset(part, 0, size);
    ensemble_part_solve(worker->part, &asked, solved);
    head.seal = seal_part(&head, solved, size - sizeof head);
    memcpy(part, &head, sizeof head);
    return PERCUSS_RESULT_OK;
}

static enum percuss_result ensemble_refuse(const char *why)
{
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "part: %s", why);
}

enum percuss_result percuss_ensemble_take(struct percuss_ensemble_sharing *sharing,
                                          const void *part, size_t size)
{
    struct part_head head;
    if (ERROR_NULL(sharing, part))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    if (size < sizeof head)
        return ensemble_refuse("too short");
    memcpy(&head, part, sizeof head);
    if (memcmp(head.kind, KIND, sizeof head.kind) != 0 || head.extras > 1)
        return ensemble_refuse("no part of an ensemble, or of another version");
    if (memcmp(&head.ensemble, &sharing->digest, sizeof head.ensemble) != 0)
        return ensemble_refuse(
            "of another request, another catalogue or another version of percuss");
    size_t item = item_size(head.extras);
    if (head.count > size / item || size != sizeof head + head.count * item)
        return ensemble_refuse("of another length than it says");
    const char *octets = (const char *)part + sizeof head;
    struct digest seal = seal_part(&head, octets, head.count * item);
    if (memcmp(&head.seal, &seal, sizeof seal) != 0)
        return ensemble_refuse("damaged on its way");
    const struct ensemble_range range = {head.extras, head.done, head.first,
                                         head.first + head.count};
    if (!ensemble_asks_for(sharing->run, &range))
        return ensemble_refuse("of items that are not asked for");
    /* octets from elsewhere lie anywhere */
    void *items = malloc(head.count * item + 1);
    if (!items)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a part");
    memcpy(items, octets, head.count * item);
    bool wanted = ensemble_take(sharing->run, &range, items);
    free(items);
    return wanted ? PERCUSS_RESULT_OK : PERCUSS_RESULT_PENDING;
}

/* Asks for a range of a run. */
static void sharing_ask(percuss_share_function *share, void *context, struct ensemble_run *run,
                        const struct ensemble_range *range)
{
    struct percuss_ensemble_sharing sharing = {run, ensemble_run_digest(run)};
    const struct percuss_ensemble_range asked = {.first = range->first,
                                                 .count = range->end - range->first,
                                                 .extras = range->extras,
                                                 .done = range->done};
    share(context, &sharing, &asked);
}

/* Its progress function, watch and samples. */
struct watcher {
    percuss_progress_function *function; /* NULL: none */
    void *context;
    struct watching watching; /* may give it up */
    double ask;               /* when it is asked next */
    bool cancelled, given_up;
    double *rows; /* of the listed samples; NULL: none */
    size_t columns;
    uint64_t listed;
    percuss_share_function *share; /* NULL: threads here solve the samples */
};

static enum ensemble_wish wish(void *context)
{
    const struct watcher *watcher = context;
    return watcher->cancelled ? ENSEMBLE_CANCELLED : ENSEMBLE_WANTED;
}

static void tell(void *context, uint64_t done, uint64_t samples,
                 const struct report_progress *progress)
{
    struct watcher *watcher = context;
    const struct percuss_ensemble_progress told = {
        .done = done,
        .samples = samples,
        .mean = progress ? progress->mean : NAN,
        .standard_deviation = progress ? progress->deviation : NAN,
        .half_width = progress ? progress->half_width : NAN,
    };
    if (watcher->function && !watcher->function(watcher->context, &told))
        watcher->cancelled = true;
    if (!watcher->given_up && !watching_asks(&watcher->watching, &watcher->ask))
        watcher->cancelled = watcher->given_up = true;
}

static bool list(void *context, const struct ensemble *ensemble,
                 const struct ensemble_sample *samples, uint64_t done)
{
    struct watcher *watcher = context;
    watcher->columns = encode_sample_columns(ensemble);
    watcher->rows = calloc(done * watcher->columns, sizeof *watcher->rows);
    if (!watcher->rows)
        return false;
    for (uint64_t i = 0; i < done; i++)
        encode_sample(ensemble, i, &samples[i], watcher->rows + i * watcher->columns);
    watcher->listed = done;
    return true;
}

/* While a table is computed before the first sample: as long as it is not cancelled. */
static enum percuss_status table_is_wanted(void *context, const struct table_maker *maker,
                                           double done, struct fault *fault)
{
    struct watcher *watcher = context;
    (void)maker, (void)done;
    tell(watcher, 0, 0, NULL);
    return watcher->cancelled ? fault_set(fault, PERCUSS_TIMEOUT, "cancelled") : PERCUSS_OK;
}

/* By the caller's share function. */
static void have_shared(void *context, struct ensemble_run *run, const struct ensemble_range *range)
{
    struct watcher *watcher = context;
    sharing_ask(watcher->share, watcher->context, run, range);
}

static struct answer *run(struct percuss_client *client, const percuss_v1_EnsembleRequest *wire,
                          struct watcher *watcher)
{
    const struct ensemble_means means = {
        .snapshot = client->snapshot,
        .tables = {.goes_on = table_is_wanted, .context = watcher},
        .limit = client->settings.limit_seconds,
        .most_samples = client->settings.limit_samples,
        .workers = client->threads,
        .wish = wish,
        .progress = tell,
        .list = list,
        .share = watcher->share ? have_shared : NULL,
        .context = watcher,
    };
    const struct ensemble_question question = {
        .request = wire,
        .envelope = {wire->client, INSTANCE_SERVER, wire->sequence, client->snapshot->set->revision,
                     PERCUSS_VERSION},
        .arrival = moment_now(),
    };
    return ensemble_answer(&means, &question);
}

/* As the public struct, with the listed samples if all are there. */
static enum percuss_result hand_over(const struct answer *answer, struct watcher *watcher,
                                     struct percuss_ensemble_reply *reply)
{
    enum percuss_result result = convert_ensemble_reply(answer->report, reply);
    if (result != PERCUSS_RESULT_OK || !watcher->rows || watcher->listed != reply->samples)
        return result;
    reply->rows = watcher->rows;
    reply->column_count = watcher->columns;
    watcher->rows = NULL;
    return PERCUSS_RESULT_OK;
}

static enum percuss_result ask(struct percuss_client *client,
                               const struct percuss_ensemble_request *request,
                               struct watcher *watcher, struct percuss_ensemble_reply *reply)
{
    percuss_v1_EnsembleRequest wire;
    *reply = (struct percuss_ensemble_reply){0};
    /* as it would be on the wire */
    struct ensemble_storage *storage = malloc(sizeof *storage);
    enum percuss_result result = storage ? convert_ensemble_request(request, storage, &wire)
                                         : error_set(PERCUSS_RESULT_NO_MEMORY, "an ensemble");
    pthread_mutex_lock(&client->lock);
    watcher->watching = client->watching;
    pthread_mutex_unlock(&client->lock);
    watcher->ask = watching_first(&watcher->watching);
    if (result == PERCUSS_RESULT_OK) {
        memcpy(wire.client, client->id, sizeof wire.client);
        wire.sequence = instance_draw_sequences(client, request->sequence, 1);
        /* solved, and told as it would be */
        struct answer *answer = run(client, &wire, watcher);
        if (watcher->given_up)
            result = watching_cancelled();
        else
            result = answer ? hand_over(answer, watcher, reply)
                            : error_set(PERCUSS_RESULT_NO_MEMORY, "the reply to an ensemble");
        answer_release(answer);
    }
    free(watcher->rows);
    free(storage);
    return result;
}

enum percuss_result local_solve_ensemble(struct percuss_client *client,
                                         const struct percuss_ensemble_request *request,
                                         double timeout, percuss_progress_function *progress,
                                         void *context, struct percuss_ensemble_reply *reply)
{
    double deadline;
    struct watcher watcher = {.function = progress, .context = context};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        return ask(client, request, &watcher, reply);
    *reply = (struct percuss_ensemble_reply){0};
    return result;
}

enum percuss_result percuss_solve_ensemble_shared(struct percuss_client *client,
                                                  const struct percuss_ensemble_request *request,
                                                  percuss_share_function *share,
                                                  percuss_progress_function *progress,
                                                  void *context,
                                                  struct percuss_ensemble_reply *reply)
{
    struct watcher watcher = {.function = progress, .context = context, .share = share};
    enum percuss_result result = ERROR_NULL(client, request, reply);
    if (result == PERCUSS_RESULT_OK)
        result = sharing_check(client);
    if (result == PERCUSS_RESULT_OK && !share)
        result = error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "share: NULL: a function is needed");
    if (result == PERCUSS_RESULT_OK)
        return ask(client, request, &watcher, reply);
    if (reply)
        *reply = (struct percuss_ensemble_reply){0};
    return result;
}
