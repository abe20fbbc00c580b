/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "arrivals.h"

#include "moment.h"

void arrivals_open(struct arrivals *arrivals)
{
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&arrivals->lock, NULL);
    pthread_cond_init(&arrivals->told, &monotonic);
    pthread_condattr_destroy(&monotonic);
    arrivals->since = (struct arrival){.any = true, .matched = true};
}

void arrivals_close(struct arrivals *arrivals)
{
    pthread_cond_destroy(&arrivals->told);
    pthread_mutex_destroy(&arrivals->lock);
}

static void tell(struct arrivals *arrivals, struct arrival what)
{
    pthread_mutex_lock(&arrivals->lock);
    arrivals->since.any = true;
    arrivals->since.matched |= what.matched;
    arrivals->since.newcomer |= what.newcomer;
    pthread_cond_signal(&arrivals->told);
    pthread_mutex_unlock(&arrivals->lock);
}

void arrivals_again(struct arrivals *arrivals)
{
    tell(arrivals, (struct arrival){0});
}

static void samples_came(dds_entity_t reader, void *arrivals)
{
    (void)reader;
    tell(arrivals, (struct arrival){0});
}

static void writers_changed(dds_entity_t reader, dds_subscription_matched_status_t status,
                            void *arrivals)
{
    (void)reader;
    tell(arrivals, (struct arrival){.matched = true, .newcomer = status.total_count_change > 0});
}

static void readers_changed(dds_entity_t writer, dds_publication_matched_status_t status,
                            void *arrivals)
{
    (void)writer, (void)status;
    tell(arrivals, (struct arrival){0});
}

void arrivals_hear_samples(dds_listener_t *listener, struct arrivals *arrivals)
{
    dds_lset_data_available_arg(listener, samples_came, arrivals, true);
}

void arrivals_hear_writers(dds_listener_t *listener, struct arrivals *arrivals)
{
    dds_lset_subscription_matched_arg(listener, writers_changed, arrivals, true);
}

void arrivals_hear_readers(dds_listener_t *listener, struct arrivals *arrivals)
{
    dds_lset_publication_matched_arg(listener, readers_changed, arrivals, true);
}

struct arrival arrivals_await(struct arrivals *arrivals, double seconds)
{
    const double until = moment_now() + seconds;
    struct timespec time = {.tv_sec = (time_t)until};
    time.tv_nsec = (long)(1e9 * (until - (double)time.tv_sec));
    pthread_mutex_lock(&arrivals->lock);
    while (!arrivals->since.any &&
           pthread_cond_timedwait(&arrivals->told, &arrivals->lock, &time) == 0)
        continue;
    const struct arrival came = arrivals->since;
    arrivals->since = (struct arrival){0};
    pthread_mutex_unlock(&arrivals->lock);
    return came;
}
