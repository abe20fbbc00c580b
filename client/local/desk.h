/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where one thread at a time answers questions: a workspace of the solver and what goes with it. */
#ifndef PERCUSS_LOCAL_DESK_H
#define PERCUSS_LOCAL_DESK_H

#include "instance.h"

/* Who waits for the answer, and how long. */
struct patience {
    double deadline;          /* moment_now() at which it is given up */
    struct watching watching; /* whoever may give it up */
    double ask;               /* when he is asked next */
    bool over;                /* it was given up, */
    bool cancelled;           /* by him */
};

/* A question of `still_wanted`, with a patience as its context. */
enum percuss_status desk_is_wanted(void *patience, struct fault *fault);

struct desk {
    struct responder *responder;
    struct patience patience; /* with the question at hand */
    struct desk *next;        /* of the idle ones */
};

/* A desk for the calling thread, until it is given back; NULL: out of memory. */
struct desk *desk_take(struct percuss_client *client, double deadline);
void desk_give(struct percuss_client *client, struct desk *desk);

/* Frees those that are idle. */
void desk_free_all(struct percuss_client *client);

#endif
