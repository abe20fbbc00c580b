/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How far it is, and how long it will take, on standard error: one line that is written over on a
 * terminal, else a line now and then. */
#ifndef PERCUSS_REDUCE_PROGRESS_H
#define PERCUSS_REDUCE_PROGRESS_H

#include <stdbool.h>

struct progress {
    const char *label;     /* what is done now */
    bool terminal, stages; /* a line for each stage too */
    double pause;          /* s between lines */
    double start, told;    /* s of a clock */
    double from, share;    /* of the whole: before what is told now, and its own */
};

/* `pause` in s; 0: what is good for a reader of standard error. */
struct progress progress_begin(double pause);

/* What comes now is so much of the whole, from there. */
void progress_stage(struct progress *progress, const char *label, double from, double share);

/* `proceed` of struct watch; always true. */
bool progress_show(void *progress, double done);

void progress_clear(const struct progress *progress);

/* Since progress_begin. */
double progress_seconds(const struct progress *progress);

#endif
