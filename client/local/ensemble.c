/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble: its samples solved by threads that end with it, and reported. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "error.h"
#include "exchange/encode_ensemble.h"
#include "instance.h"
#include "library.h"
#include "moment.h"
#include "respond/ensemble_answer.h"
#include "sharing.h"

/* Who watches it. */
struct watcher {
    percuss_progress_function *function; /* NULL: nobody */
    void *context;
    struct watching watching; /* whoever may give it up */
    double ask;               /* when he is asked next */
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

/* By whoever the caller knows. */
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
