/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What takes the server long, for its status. Any thread. */
#ifndef PERCUSS_DAEMON_ACTIVITY_H
#define PERCUSS_DAEMON_ACTIVITY_H

#include <pthread.h>

struct activity {
    pthread_mutex_t lock; /* of all below */
    const void *owner;    /* whose it is; NULL: nobody's */
    char text[128];       /* empty: nothing */
    double progress;      /* 0 .. 1; NAN: nothing */
    double begun;         /* monotonic, s; NAN: nothing */
};

void activity_create(struct activity *activity);
void activity_release(struct activity *activity);

/* What runs, in words, and how far it is. `owner` tells it from others that run at the same time:
 * it is heard unless another one is, until that one clears it. */
void activity_set(struct activity *activity, const void *owner, double progress, const char *format,
                  ...) __attribute__((format(printf, 4, 5)));

/* That of `owner` has ended. */
void activity_clear(struct activity *activity, const void *owner);

/* Copies it; the text is cut to fit. */
void activity_read(struct activity *activity, char *text, size_t size, double *progress);

/* When what runs began, monotonic, s; NAN: nothing does. */
double activity_begun(struct activity *activity);

#endif
