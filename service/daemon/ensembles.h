/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The ensembles that wait or run: to cancel them, and to say what the server is doing. Thread-safe.
 */
#ifndef PERCUSS_DAEMON_ENSEMBLES_H
#define PERCUSS_DAEMON_ENSEMBLES_H

#include <pthread.h>

#include "daemon/job.h"

struct ensembles {
    pthread_mutex_t lock;
    LIST_HEAD(ensemble_list, job) all;
    uint64_t done, samples; /* of the one that runs; samples 0: none does */
};

void ensembles_create(struct ensembles *ensembles);
void ensembles_release(struct ensembles *ensembles);

void ensembles_enter(struct ensembles *ensembles, struct job *job);
void ensembles_leave(struct ensembles *ensembles, struct job *job);

/* The client does not want it any more; nothing happens if there is no such ensemble. */
void ensembles_cancel(struct ensembles *ensembles, const uint8_t client[16], uint64_t sequence);

/* Tells each that waits for `running` to end. */
void ensembles_tell_waiting(struct ensembles *ensembles, const struct job *running,
                            void (*tell)(void *context, const struct job *waiting), void *context);

/* The server ends. */
void ensembles_cancel_all(struct ensembles *ensembles);

void ensembles_note(struct ensembles *ensembles, uint64_t done, uint64_t samples);

/* What runs, in words, and how far it is, 0 .. 1; empty and NAN for nothing. */
void ensembles_describe(struct ensembles *ensembles, char text[256], double *progress);

#endif
