/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the doctor has looked at, and whether something is wrong with it. */
#ifndef PERCUSS_DOCTOR_FINDING_H
#define PERCUSS_DOCTOR_FINDING_H

#include <stdbool.h>
#include <stddef.h>

enum finding_level { FINDING_OK, FINDING_WARNING, FINDING_PROBLEM };

/* Goes through a pipe in one piece: smaller than PIPE_BUF. */
struct finding {
    enum finding_level level;
    char subject[24]; /* what was looked at */
    char found[1200];
    char advice[1200]; /* what to do; empty: nothing */
};

struct findings {
    struct finding *each; /* for free() */
    size_t count;
    int pipe; /* where they go instead; 0: they are kept here */
};

/* "ok", "warning", "problem". */
const char *finding_level_name(enum finding_level level);

/* `advice` may be NULL. What there is no memory for is left out. */
void findings_add(struct findings *findings, enum finding_level level, const char *subject,
                  const char *advice, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Keeps one that came through a pipe. */
void findings_keep(struct findings *findings, const struct finding *finding);

#endif
