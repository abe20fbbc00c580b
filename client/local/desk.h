/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A place where one thread at a time answers questions: a workspace of the solver with its
 * patience. */
#ifndef PERCUSS_LOCAL_DESK_H
#define PERCUSS_LOCAL_DESK_H

#include "instance.h"

/* The wait for the answer: its end, and its watch. */
struct patience {
    double deadline;          /* moment_now() at which it is given up */
    struct watching watching; /* may give it up */
    double ask;               /* when it is asked next */
    bool over;                /* it was given up, */
    bool cancelled;           /* by the watch */
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
