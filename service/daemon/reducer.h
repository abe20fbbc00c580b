/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Runs percuss-reduce for the bodies that a catalogue orders, one at a time, while others are
 * answered. Of the main thread. */
#ifndef PERCUSS_DAEMON_REDUCER_H
#define PERCUSS_DAEMON_REDUCER_H

#include <stdbool.h>
#include <sys/types.h>

#include "model/body.h"

enum { REDUCER_FILES = 3 };

struct reducer {
    const char *folder; /* borrowed; empty: nothing is reduced */
    pid_t child;        /* 0: none */
    bool halted;        /* nothing can be started or noted, which the log has said */
    char id[PERCUSS_ID_SIZE], name[65];
    char *files[REDUCER_FILES]; /* of the child: body, messages, material; NULL: none */
};

/* Failures of before are forgotten: what lacks is tried again. */
void reducer_begin(struct reducer *reducer, const char *folder);
void reducer_forget(struct reducer *reducer);

/* Starts the next of the set's orders if nothing runs. True: one has ended, well or not, so that
 * the catalogue is to be loaded again. */
bool reducer_look(struct reducer *reducer, const struct body_set *set);

/* Stops what runs, for good. */
void reducer_end(struct reducer *reducer);

#endif
