/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble answered: decoded, its samples solved by threads or processes, and reported. */
#ifndef PERCUSS_RESPOND_ENSEMBLE_ANSWER_H
#define PERCUSS_RESPOND_ENSEMBLE_ANSWER_H

#include "base/hash.h"
#include "ensemble/report.h"
#include "exchange/answer.h"
#include "respond/snapshot.h"
#include "respond/table_maker.h"

/* Whether its client wants the rest of it. */
enum ensemble_wish {
    ENSEMBLE_WANTED,
    ENSEMBLE_CANCELLED, /* the samples solved by now are enough */
    ENSEMBLE_GONE       /* the client has gone */
};

/* Some of the samples, or of the extras to samples 0 .. done - 1 (ensemble/extras.h): items first
 * .. end - 1. */
struct ensemble_range {
    bool extras;
    uint64_t done; /* of extras */
    uint64_t first, end;
};

struct ensemble_run; /* an ensemble while it is answered */

/* The means to answer it. The functions are called in the thread of ensemble_answer, except `beat`;
 * only `beat` and `share` may be NULL. */
struct ensemble_means {
    const struct snapshot *snapshot;
    struct table_wait tables;
    double limit;          /* of the time for one request, s */
    unsigned most_samples; /* allowed in a request */
    unsigned workers;      /* threads */
    int nice;              /* of the threads */
    void (*beat)(void);    /* progress of it or of a worker */
    /* called about ten times a second */
    enum ensemble_wish (*wish)(void *context);
    /* Its progress, as often; `progress` NULL: the model is chosen, once a second. */
    void (*progress)(void *context, uint64_t done, uint64_t samples,
                     const struct report_progress *progress);
    /* The first `done` samples, where they are to be listed. False: out of memory. */
    bool (*list)(void *context, const struct ensemble *ensemble,
                 const struct ensemble_sample *samples, uint64_t done);
    /* Has a range of items solved elsewhere, in parts, each of which it gives to ensemble_take, in
     * any order; false there: no more are wanted. NULL: threads here solve them. */
    void (*share)(void *context, struct ensemble_run *run, const struct ensemble_range *range);
    void *context;
};

struct ensemble_question {
    const percuss_v1_EnsembleRequest *request;
    struct envelope envelope; /* of the reply */
    double arrival;           /* monotonic, s */
};

/* The message to a client that had gone. */
#define ENSEMBLE_CLIENT_GONE "the client had gone: ask again"

/* The reply, a refusal included; NULL: out of memory. It ends early, with the samples solved so
 * far, when it is cancelled or its deadline passes, and without any when its client is gone. */
struct answer *ensemble_answer(const struct ensemble_means *means,
                               const struct ensemble_question *question);

/* Whether the items of a range are among those that `share` was asked for last. */
bool ensemble_asks_for(const struct ensemble_run *run, const struct ensemble_range *range);

/* Takes range->end - range->first items that `share` was asked for: struct ensemble_sample or
 * struct ensemble_extra. Of the thread of ensemble_answer. False: no more are wanted. */
bool ensemble_take(struct ensemble_run *run, const struct ensemble_range *range, const void *items);

/* A hash that is the same in all processes that share the samples, known once `share` is called. */
struct digest ensemble_run_digest(const struct ensemble_run *run);

/* A solver of some items of an ensemble, in any process: item i is a function of the request and of
 * i alone. One thread. */
struct ensemble_part;

/* Chooses the model, as all processes that share the ensemble do. Of the means it uses snapshot,
 * tables, limit and most_samples; means and question are borrowed until it is freed. Status and
 * fault as of the ensemble; *part is NULL then. */
enum percuss_status ensemble_part_create(const struct ensemble_means *means,
                                         const struct ensemble_question *question,
                                         struct ensemble_part **part, struct fault *fault);
void ensemble_part_free(struct ensemble_part *part); /* NULL is allowed */

/* As ensemble_run_digest. */
struct digest ensemble_part_digest(const struct ensemble_part *part);

/* Number of items that ranges are of: samples, or extras to `done` samples. */
uint64_t ensemble_part_items(const struct ensemble_part *part, bool extras, uint64_t done);

/* Solves the range into `items`: an array of struct ensemble_sample or ensemble_extra. */
void ensemble_part_solve(struct ensemble_part *part, const struct ensemble_range *range,
                         void *items);

#endif
