/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One request answered: validated, its states looked up, solved, and put into a reply. */
#ifndef PERCUSS_DAEMON_RESPONDER_H
#define PERCUSS_DAEMON_RESPONDER_H

#include <stdbool.h>

#include "daemon/table_maker.h"
#include "exchange/answer.h"
#include "solve/solve.h"

/* What one thread needs to answer requests. */
struct responder {
    struct token_store *tokens;
    double limit;   /* of the time for one solve, s */
    enum lane lane; /* that it works in */
    struct solve_workspace *workspace;
    struct table_maker maker; /* of contact tables that requests insist on */
    struct solve_request request;
    struct solve_result result;
    char states_after[PERCUSS_MAX_BODIES][PERCUSS_ID_SIZE]; /* their tokens */
};

/* In the lane of tables those that are missing are computed when a request insists on them, which
 * takes seconds to minutes. NULL: out of memory. */
struct responder *responder_create(struct shared *shared, enum lane lane);
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
};

/* The reply, whatever it says; it differs with the thread, the load and the time in its timing
 * only, and where a deadline passed or nobody waits any more: then it is not to be kept
 * (answer.passing). NULL: out of memory. */
struct answer *responder_answer(struct responder *responder, const struct question *question);

#endif
