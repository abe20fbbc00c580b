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

/* What it answers by. */
struct respond_means {
    struct token_store *tokens; /* borrowed */
    double limit;               /* of the time for one request, s */
    struct table_wait tables;   /* while one is computed; without goes_on none are */
    void (*beat)(void);         /* once a millisecond of a solve; NULL: nobody listens */
    /* an answer is INTERNAL; NULL: nobody wants to know */
    void (*complain)(const struct envelope *envelope, const char *text);
};

/* What one thread needs to answer requests. */
struct responder {
    struct respond_means means;
    int lane; /* its owner's: in which it works */
    struct solve_workspace *workspace;
    struct table_maker maker; /* of contact tables that requests insist on */
    struct solve_request request;
    struct solve_result result;
    char states_after[PERCUSS_MAX_BODIES][PERCUSS_ID_SIZE]; /* their tokens */
};

/* NULL: out of memory. */
struct responder *responder_create(const struct respond_means *means);
void responder_free(struct responder *responder); /* NULL is allowed */

/* A request with where it came from. */
struct question {
    const percuss_v1_Request *request;
    const struct snapshot *snapshot; /* it is answered from */
    struct envelope envelope;        /* of the reply */
    double arrival;                  /* monotonic, s */
    bool in_batch;
    /* OK while somebody waits for the answer, otherwise what to refuse it with; asked about once a
     * millisecond of the solve */
    enum percuss_status (*still_wanted)(void *context, struct fault *fault);
    void *context;                             /* of that */
    const struct body_state *const *specimens; /* by body; NULL: specimens are refused */
    _Atomic double *done; /* is told now and then which share is done, where that is known; NULL:
                             nobody looks */
};

/* The reply, whatever it says; it differs with the thread, the load and the time in its timing
 * only, and where a deadline passed or nobody waits any more: then it is not to be kept
 * (answer.passing). NULL: out of memory. */
struct answer *responder_answer(struct responder *responder, const struct question *question);

#endif
