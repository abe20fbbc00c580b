/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One ensemble answered: decoded, its samples solved by several threads, and reported. */
#ifndef PERCUSS_RESPOND_ENSEMBLE_ANSWER_H
#define PERCUSS_RESPOND_ENSEMBLE_ANSWER_H

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

/* What it is answered by. The functions are called in the thread of ensemble_answer, but for
 * `beat`, and none may be NULL but that. */
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
    void *context;
};

struct ensemble_question {
    const percuss_v1_EnsembleRequest *request;
    struct envelope envelope; /* of the reply */
    double arrival;           /* monotonic, s */
};

/* What is said where nobody is there any more. */
#define ENSEMBLE_CLIENT_GONE "the client had gone: ask again"

/* The reply, whatever it says; NULL: out of memory. It ends early, with the samples solved so far,
 * when it is cancelled or its deadline passes, and without any when its client is gone. */
struct answer *ensemble_answer(const struct ensemble_means *means,
                               const struct ensemble_question *question);

#endif
