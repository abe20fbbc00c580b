/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What an ensemble is answered by, and what is asked. */
#ifndef PERCUSS_RESPOND_ENSEMBLE_MEANS_H
#define PERCUSS_RESPOND_ENSEMBLE_MEANS_H

#include "ensemble/report.h"
#include "exchange/answer.h"
#include "respond/snapshot.h"
#include "respond/table_maker.h"

/* Whether its client wants the rest of it. */
enum ensemble_wish {
    ENSEMBLE_WANTED,
    ENSEMBLE_CANCELLED, /* what is solved by now is enough */
    ENSEMBLE_GONE       /* nobody is there any more */
};

/* Some of the samples, or of the extras to samples 0 .. done - 1 (ensemble/extras.h): items first
 * .. end - 1. */
struct ensemble_range {
    bool extras;
    uint64_t done; /* of extras */
    uint64_t first, end;
};

struct ensemble_run; /* one that is under way */

/* What it is answered by. The functions are called in the thread of ensemble_answer, but for
 * `beat`, and none may be NULL but that and `share`. */
struct ensemble_means {
    const struct snapshot *snapshot;
    struct table_wait tables;
    double limit;          /* of the time for one request, s */
    unsigned most_samples; /* that may be asked for */
    unsigned workers;      /* threads */
    int nice;              /* of theirs */
    void (*beat)(void);    /* it moves, or a worker does */
    /* looked at about ten times a second */
    enum ensemble_wish (*wish)(void *context);
    /* How far it is, as often; `progress` NULL: the model is chosen, once a second. */
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

#endif
