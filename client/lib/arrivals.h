/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Waiting for samples and for servers that come and go. Waitsets of Cyclone DDS 0.10.2 wait until a
 * time of day (ddsrt_cond_waituntil): set back by an hour, they wait for an hour longer. This waits
 * by the monotonic clock. */
#ifndef PERCUSS_LIB_ARRIVALS_H
#define PERCUSS_LIB_ARRIVALS_H

#include <dds/dds.h>
#include <pthread.h>
#include <stdbool.h>

/* What has come since the last look. */
struct arrival {
    bool any;      /* a sample, a writer of replies or a reader of requests; or one has gone */
    bool matched;  /* a writer of replies has come or gone */
    bool newcomer; /* one has come */
};

struct arrivals {
    pthread_mutex_t lock;
    pthread_cond_t told;
    struct arrival since;
};

/* The first wait ends at once: samples may be there already. */
void arrivals_open(struct arrivals *arrivals);
void arrivals_close(struct arrivals *arrivals);

/* Has threads of DDS tell of a reader's samples, of writers of replies and of readers of requests,
 * by functions of that listener, whose argument is `arrivals`. */
void arrivals_hear_samples(dds_listener_t *listener, struct arrivals *arrivals);
void arrivals_hear_writers(dds_listener_t *listener, struct arrivals *arrivals);
void arrivals_hear_readers(dds_listener_t *listener, struct arrivals *arrivals);

/* What came was not taken: the next wait ends at once. */
void arrivals_again(struct arrivals *arrivals);

/* Waits up to so many seconds; all false: nothing has come. One thread at a time. */
struct arrival arrivals_await(struct arrivals *arrivals, double seconds);

#endif
