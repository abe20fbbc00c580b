/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/ensembles.h"

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

void ensembles_enter(struct ensembles *ensembles, struct ensemble_entry *entry)
{
    pthread_mutex_lock(&ensembles->lock);
    LIST_INSERT_HEAD(&ensembles->all, entry, all);
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_leave(struct ensembles *ensembles, struct ensemble_entry *entry)
{
    pthread_mutex_lock(&ensembles->lock);
    LIST_REMOVE(entry, all);
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_cancel(struct ensembles *ensembles, const uint8_t client[16], uint64_t sequence)
{
    struct ensemble_entry *entry;
    pthread_mutex_lock(&ensembles->lock);
    LIST_FOREACH(entry, &ensembles->all, all)
    {
        if (entry->sequence == sequence && memcmp(entry->client, client, 16) == 0)
            atomic_store(&entry->cancelled, true);
    }
    pthread_mutex_unlock(&ensembles->lock);
}

void ensembles_visit_waiting(struct ensembles *ensembles,
                             void (*visit)(void *context, const struct ensemble_entry *waiting),
                             void *context)
{
    struct ensemble_entry *entry;
    pthread_mutex_lock(&ensembles->lock);
    LIST_FOREACH(entry, &ensembles->all, all)
    {
        if (!atomic_load(&entry->running))
            visit(context, entry);
    }
    pthread_mutex_unlock(&ensembles->lock);
}
