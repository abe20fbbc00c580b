/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many jobs in a child process that may hang or crash: the guard notes where, ends it, and goes on
 * behind that job. */
#ifndef PERCUSS_BENCH_GUARDED_H
#define PERCUSS_BENCH_GUARDED_H

#include <stddef.h>
#include <stdint.h>

/* In memory shared with the child. */
struct guarded_place {
    uint64_t job;    /* under way */
    double started;  /* processor time of the child when it began, s */
    uint64_t resume; /* the first job that is not done */
};

enum { GUARDED_MOST_LOST = 64 };

struct guarded {
    /* Does all jobs from place->resume on, below `end`; keeps `place` up to date. In the child. */
    void (*work)(void *context, struct guarded_place *place, uint64_t end);
    void *context;
    double patience; /* processor time that one job may take, s */

    struct {
        uint64_t job;
        int signal; /* that ended it; 0: the guard did, for its time */
    } lost[GUARDED_MOST_LOST];
    size_t lost_count; /* exact, may exceed the list */
};

/* Zeroed memory that a child's writes are seen in; ends the program without memory. */
void *guarded_memory(size_t size);

/* Processor time of this process, s. */
double guarded_clock(void);

/* Runs the jobs first ... end - 1. */
void guarded_run(struct guarded *guarded, uint64_t first, uint64_t end);

#endif
