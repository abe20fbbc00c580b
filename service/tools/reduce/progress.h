/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Progress on standard error. */
#ifndef PERCUSS_REDUCE_PROGRESS_H
#define PERCUSS_REDUCE_PROGRESS_H

#include <stdbool.h>

/* One line that is written over on a terminal, else a line now and then. */
struct progress {
    const char *label;     /* of the present stage */
    bool terminal, stages; /* a line for each stage too */
    double pause;          /* s between lines */
    double start, told;    /* s of a clock */
    double from, share;    /* of the work: before the present stage, and its own */
    double work, expected; /* s: when modes began to be sought, and all from there on; 0: unknown */
};

/* `pause` in s; 0: a pause that suits standard error. */
struct progress progress_begin(double pause);

/* Since then. */
double progress_seconds(const struct progress *progress);

/* The next stage begins at the part `from` of the whole and is `share` of it. */
void progress_stage(struct progress *progress, const char *label, double from, double share);

/* `proceed` of struct watch; always true. */
bool progress_show(void *context, double done);

/* Nothing of it stays on a terminal's line. */
void progress_clear(const struct progress *progress);

#endif
