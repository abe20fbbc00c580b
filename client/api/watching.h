/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The watch that percuss_client_watch has set. */
#ifndef PERCUSS_API_WATCHING_H
#define PERCUSS_API_WATCHING_H

#include <percuss/watch.h>
#include <pthread.h>

/* Between two calls of the watch, s. */
static const double WATCHING_INTERVAL = 0.1;

struct watching {
    percuss_watch_function *function; /* NULL: no watch */
    void *context;
    pthread_t thread; /* its calls are watched */
};

/* By the calling thread. */
struct watching watching_begin(percuss_watch_function *function, void *context);

/* When the calling thread is to ask for the first time; INFINITY: it is not watched. */
double watching_first(const struct watching *watching);

/* Whether the call is to go on, if it is time to ask, and when to ask next. */
bool watching_asks(const struct watching *watching, double *next);

/* That it is not. */
enum percuss_result watching_cancelled(void);

#endif
