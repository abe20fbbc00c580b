/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The ensembles that wait or run, for those who want them cancelled or wait for their turn. Any
 * thread. */
#ifndef PERCUSS_DAEMON_ENSEMBLES_H
#define PERCUSS_DAEMON_ENSEMBLES_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/queue.h>

struct ensemble_entry {
    LIST_ENTRY(ensemble_entry) all; /* under the lock */
    const uint8_t *client;          /* 16 octets */
    uint64_t sequence;
    uint64_t samples;      /* that are asked for */
    atomic_bool running;   /* it does not wait for its turn any more */
    atomic_bool cancelled; /* no more of them are wanted */
};

struct ensembles {
    pthread_mutex_t lock;
    LIST_HEAD(ensemble_list, ensemble_entry) all;
};

void ensembles_create(struct ensembles *ensembles);
void ensembles_release(struct ensembles *ensembles);

/* The entry, filled by the caller, must stay where it is until it leaves. */
void ensembles_enter(struct ensembles *ensembles, struct ensemble_entry *entry);
void ensembles_leave(struct ensembles *ensembles, struct ensemble_entry *entry);

/* The client does not want it any more; nothing happens if there is no such ensemble. */
void ensembles_cancel(struct ensembles *ensembles, const uint8_t client[16], uint64_t sequence);

/* Shows each that waits for its turn. */
void ensembles_visit_waiting(struct ensembles *ensembles,
                             void (*visit)(void *context, const struct ensemble_entry *waiting),
                             void *context);

#endif
