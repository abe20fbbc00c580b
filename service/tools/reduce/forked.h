/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A work in parts, by several processes: this one and forked copies of it. Debian's serial OpenBLAS
 * allows one thread at a time (numeric/linear.h), and MUMPS has one factor, of which each copy has
 * its own without any memory being copied. A part computes the same whoever does it. */
#ifndef PERCUSS_REDUCE_FORKED_H
#define PERCUSS_REDUCE_FORKED_H

#include <sys/types.h>

#include "base/watch.h"

struct forked_work {
    size_t parts;
    size_t processes; /* at most; 0 counts as 1 */
    /* Results go to memory of forked_memory; all else that it writes may be lost. */
    enum percuss_status (*part)(void *context, size_t part, struct fault *fault);
    void *context;
    const struct watch *watch; /* told the part done, and asked between parts; NULL: no watch */
};

/* All parts, in any order. What a copy has not finished, because it failed, was killed or could not
 * be made, is done here. PERCUSS_TIMEOUT: the watch stopped it; else the status of a part. */
enum percuss_status forked_run(const struct forked_work *work, struct fault *fault);

/* A copy that does a work while this process goes on; results go to memory of forked_memory. -1: no
 * copy could be made. */
pid_t forked_begin(bool (*work)(void *context), void *context);

/* Waits for it. False: the work is not done, as it returned false, was killed, or copy is -1. */
bool forked_end(pid_t copy);

/* Ends it, unless copy is -1. */
void forked_drop(pid_t copy);

/* Zeroed memory that copies share; NULL: there is none. */
void *forked_memory(size_t bytes);
void forked_memory_free(void *memory, size_t bytes); /* NULL is allowed */

/* Processors that this process may use. */
size_t forked_processors(void);

#endif
