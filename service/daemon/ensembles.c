/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/ensembles.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void ensembles_create(struct ensembles *ensembles)
{
    pthread_mutex_init(&ensembles->lock, NULL);
    LIST_INIT(&ensembles->all);
}

void ensembles_release(struct ensembles *ensembles)
{
    pthread_mutex_destroy(&ensembles->lock);
}

void ensembles_enter(struct ensembles *ensembles, struct job *job)
{
    pthread_mutex_lock(&ensembles->lock);
    LIST_INSERT_HEAD(&ensembles->all, job, ensembles);
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_leave(struct ensembles *ensembles, struct job *job)
{
    pthread_mutex_lock(&ensembles->lock);
    LIST_REMOVE(job, ensembles);
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_cancel(struct ensembles *ensembles, const uint8_t client[16], uint64_t sequence)
{
    struct job *job;
    pthread_mutex_lock(&ensembles->lock);
    LIST_FOREACH(job, &ensembles->all, ensembles)
    {
        if (job->sequence == sequence && memcmp(job->client, client, sizeof job->client) == 0)
            atomic_store(&job->cancelled, true);
    }
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_tell_waiting(struct ensembles *ensembles, const struct job *running,
                            void (*tell)(void *context, const struct job *waiting), void *context)
{
    struct job *job;
    pthread_mutex_lock(&ensembles->lock);
    LIST_FOREACH(job, &ensembles->all, ensembles)
    {
        if (job != running)
            tell(context, job);
    }
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_cancel_all(struct ensembles *ensembles)
{
    struct job *job;
    pthread_mutex_lock(&ensembles->lock);
    LIST_FOREACH(job, &ensembles->all, ensembles)
    atomic_store(&job->cancelled, true);
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_note(struct ensembles *ensembles, uint64_t done, uint64_t samples)
{
    pthread_mutex_lock(&ensembles->lock);
    ensembles->done = done;
    ensembles->samples = samples;
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_describe(struct ensembles *ensembles, char text[256], double *progress)
{
    pthread_mutex_lock(&ensembles->lock);
    *progress = NAN;
    text[0] = '\0';
    if (ensembles->samples > 0) {
        *progress = (double)ensembles->done / (double)ensembles->samples;
        snprintf(text, 256, "ensemble: %llu of %llu samples", (unsigned long long)ensembles->done,
                 (unsigned long long)ensembles->samples);
    }
    pthread_mutex_unlock(&ensembles->lock);
}
