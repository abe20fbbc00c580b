/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies that the daemon reduces from meshes: it runs percuss-reduce for those that a catalogue
 * orders, and for places of theirs whose flexibility requests need, one at a time, while it answers
 * requests, and keeps the folder of the reduced bodies,
 * which daemons with different catalogues may share. Of the main thread. */
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
    char halted[400];   /* the reason why no child is started any more; empty: none */
    bool adding;        /* the child adds sites to a body that is there */
    char id[PERCUSS_ID_SIZE], name[65];
    double done;                /* of the child: 0 .. 1 */
    char *files[REDUCER_FILES]; /* of the child: body, messages, material; NULL: none */
};

/* Earlier failures are forgotten: each missing body is tried. */
void reducer_begin(struct reducer *reducer, const char *folder);

/* Reductions that could not be started, or were killed, are tried again. Meshes that percuss-reduce
 * has refused are not: it would refuse them again. */
void reducer_retry(struct reducer *reducer);

/* Starts the next of the set's orders if no child runs, and tells its progress. True: one has
 * ended, well or not, so that the catalogue is to be loaded again. */
bool reducer_look(struct reducer *reducer, const struct body_set *set);

/* The catalogue cannot be loaded again with the bodies that are there now: the orders say so. */
void reducer_unloaded(const struct reducer *reducer, const struct body_set *set,
                      const struct fault *fault);

/* Ends the child, and starts no further one. */
void reducer_end(struct reducer *reducer);

/* Marks the bodies of the set as used now, by the times of their files, and deletes those that no
 * set has used for so many days, and files that reductions of ended processes left. Other files
 * stay. */
void reducer_tidy(const char *folder, const struct body_set *set, double days);

/* Whether reduced bodies can be written to that folder, which is or can be made.
 * PERCUSS_BAD_REQUEST with "FOLDER: ...". */
enum percuss_status reducer_check_folder(const char *folder, struct fault *fault);

#endif
