/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Runs percuss-reduce for the bodies that a catalogue orders, one at a time, while others are
 * answered. Of the main thread. */
#ifndef PERCUSS_DAEMON_REDUCER_H
#define PERCUSS_DAEMON_REDUCER_H

#include <stdbool.h>
#include <sys/types.h>

#include "base/fault.h"
#include "model/body.h"

enum { REDUCER_FILES = 3 };

struct reducer {
    const char *folder; /* borrowed; empty: nothing is reduced */
    pid_t child;        /* 0: none */
    char halted[400];   /* why nothing is started any more; empty: it is */
    char id[PERCUSS_ID_SIZE], name[65];
    double done;                /* of the child: 0 .. 1 */
    char *files[REDUCER_FILES]; /* of the child: body, messages, material; NULL: none */
};

/* Failures of before are forgotten: what lacks is tried. */
void reducer_begin(struct reducer *reducer, const char *folder);

/* What could not be started, or was killed, is tried again. What percuss-reduce has refused is not:
 * it would refuse it again. */
void reducer_retry(struct reducer *reducer);

/* Starts the next of the set's orders if nothing runs, and tells how far it is. True: one has
 * ended, well or not, so that the catalogue is to be loaded again. */
bool reducer_look(struct reducer *reducer, const struct body_set *set);

/* The catalogue cannot be loaded again: bodies that are there now do not go with it. */
void reducer_unloaded(const struct reducer *reducer, const struct body_set *set,
                      const struct fault *fault);

/* Stops what runs, for good. */
void reducer_end(struct reducer *reducer);

#endif
