/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One request answered: validated, its states looked up, solved, and put into a reply. */
#ifndef PERCUSS_RESPOND_RESPONDER_H
#define PERCUSS_RESPOND_RESPONDER_H

#include <stdbool.h>

#include "exchange/answer.h"
#include "exchange/token_store.h"
#include "respond/snapshot.h"
#include "respond/table_maker.h"
#include "solve/solve.h"

/* The means to answer. */
struct respond_means {
    struct token_store *tokens;    /* borrowed */
    struct solve_account *account; /* borrowed: of prepared bodies; NULL: they are not bounded */
    double limit;                  /* of the time for one request, s */
    struct table_wait tables;      /* while one is computed; without goes_on none are */
    void (*beat)(void);            /* once a millisecond of a solve; may be NULL */
    /* an answer is INTERNAL; may be NULL */
    void (*complain)(const struct envelope *envelope, const char *text);
};

/* The state of one thread that answers requests. */
struct responder {
    struct respond_means means;
    int lane; /* the owner's, in which it works */
    struct solve_workspace *workspace;
    struct table_maker maker; /* of contact tables that requests insist on */
    struct solve_request request;
    struct solve_result result;
    char states_after[PERCUSS_MAX_BODIES][PERCUSS_ID_SIZE]; /* their tokens */
};

/* NULL: out of memory. */
struct responder *responder_create(const struct respond_means *means);
void responder_free(struct responder *responder); /* NULL is allowed */

/* A request with its origin. */
struct question {
    const percuss_v1_Request *request;
    const struct snapshot *snapshot; /* it is answered from */
    struct envelope envelope;        /* of the reply */
    double arrival;                  /* monotonic, s */
    bool in_batch;
    /* OK while the client waits for the answer, otherwise the status of the refusal; called about
     * once a millisecond of the solve */
    enum percuss_status (*still_wanted)(void *context, struct fault *fault);
    void *context;                             /* of that */
    const struct body_state *const *specimens; /* by body; NULL: specimens are refused */
    _Atomic double *done; /* receives the share that is done, where known; may be NULL */
};

/* The reply, a refusal included; it depends on the thread, the load and the time in its timing
 * only, and where a deadline passed or the client waits no more: then it is not to be kept
 * (answer.passing). NULL: out of memory. */
struct answer *responder_answer(struct responder *responder, const struct question *question);

/* The answer is made and its result needed no more: what the solve took beyond its account is given
 * back. */
void responder_settle(struct responder *responder);

#endif
