/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The points of a curve asked for, several at a time, and told of in their order. */
#ifndef PERCUSS_CLI_SWEEP_RUN_H
#define PERCUSS_CLI_SWEEP_RUN_H

#include <stdbool.h>

#include "scene.h"

/* Hears of point i, once it and all before it are there. False: no more of them are wanted. */
typedef bool sweep_run_ready(void *context, unsigned i);

struct sweep_run {
    const struct common *common;
    struct percuss_client *client;
    struct scene scene; /* of this curve */
    struct scene_bodies bodies;
    const double *speeds;
    unsigned count;
    unsigned first; /* points before it are known already */
    sweep_run_ready *ready;
    void *context;                 /* of that */
    struct percuss_reply *replies; /* one a speed; those below `first` are empty */
    bool *there;
    uint64_t *sequences;
    unsigned sent, answered, told;
};

/* Asks for the points from `first` on; what is set above `replies` is the caller's. Exit code;
 * complains. Whatever it is, the points below `told` are there. To be released. */
int sweep_run_ask(struct sweep_run *run);
void sweep_run_release(struct sweep_run *run);

/* Asks for one point by itself. The reply is the caller's. Exit code; complains. */
int sweep_run_again(struct sweep_run *run, unsigned i, struct percuss_reply *reply);

/* From now on an interrupt (SIGINT, SIGTERM) ends the asking, and a second one the program. */
void sweep_run_catch_interrupts(void);
bool sweep_run_interrupted(void);

#endif
