/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What takes the server long, for its status. Any thread. */
#ifndef PERCUSS_DAEMON_ACTIVITY_H
#define PERCUSS_DAEMON_ACTIVITY_H

#include <pthread.h>

struct activity {
    pthread_mutex_t lock; /* of all below */
    char text[128];       /* empty: nothing */
    double progress;      /* 0 .. 1; NAN: nothing */
};

void activity_create(struct activity *activity);
void activity_release(struct activity *activity);

/* What runs, in words, and how far it is. */
void activity_set(struct activity *activity, double progress, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Nothing does any more. */
void activity_clear(struct activity *activity);

/* Copies it; the text is cut to fit. */
void activity_read(struct activity *activity, char *text, size_t size, double *progress);

#endif
