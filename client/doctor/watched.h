/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Work that may end its process, or never return: DDS with a configuration that asks for more than
 * there is. It is done by a process of its own. */
#ifndef PERCUSS_DOCTOR_WATCHED_H
#define PERCUSS_DOCTOR_WATCHED_H

#include "finding.h"

/* Returns 0 to 63. */
typedef int watched_function(void *context, struct findings *findings);

/* How it ended. */
struct watched {
    int code;   /* what it returned; -1: it did not */
    int signal; /* that has ended it; 0: none */
    bool late;  /* it was ended since its time was over */
    char *log;  /* what it has written to standard error, for free(); NULL: unknown */
};

/* Calls it in a child of this process, which must have no threads, for so many seconds at most, and
 * adds what it finds. */
void watched_run(watched_function *function, void *context, double seconds,
                 struct findings *findings, struct watched *end);

/* The same with a program: `argv` ends with NULL; its standard output is left out. */
void watched_program(char *const argv[], double seconds, struct watched *end);

#endif
