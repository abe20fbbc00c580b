/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "pending.h"

#include <stdlib.h>

#include "error.h"

static struct pending **bucket_of(struct pending_table *table, uint64_t sequence)
{
    return &table->buckets[sequence % PENDING_BUCKETS];
}

enum percuss_result pending_add(struct pending_table *table, uint64_t sequence,
                                struct pending **pending)
{
    if (table->count >= table->window)
        return error_set(PERCUSS_RESULT_WINDOW_FULL,
                         "%u requests are outstanding; collect or cancel some", table->count);
    struct pending *added = calloc(1, sizeof *added);
    if (!added)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "an outstanding request");
    struct pending **bucket = bucket_of(table, sequence);
    added->sequence = sequence;
    added->next = *bucket;
    *bucket = added;
    table->count++;
    *pending = added;
    return PERCUSS_RESULT_OK;
}

struct pending *pending_find(const struct pending_table *table, uint64_t sequence)
{
    struct pending *pending = table->buckets[sequence % PENDING_BUCKETS];
    while (pending && pending->sequence != sequence)
        pending = pending->next;
    return pending;
}

struct pending *pending_first_ready(const struct pending_table *table)
{
    struct pending *pending = table->first_ready;
    while (pending && pending->waited)
        pending = pending->next_ready;
    return pending;
}

bool pending_has_unwaited(const struct pending_table *table)
{
    for (size_t i = 0; i < PENDING_BUCKETS; i++)
        for (const struct pending *pending = table->buckets[i]; pending; pending = pending->next)
            if (!pending->waited)
                return true;
    return false;
}

void pending_orphan(struct pending_table *table)
{
    for (size_t i = 0; i < PENDING_BUCKETS; i++)
        for (struct pending *pending = table->buckets[i]; pending; pending = pending->next)
            pending->orphaned = !pending->ready;
}

const struct pending *pending_first_orphan(const struct pending_table *table)
{
    for (size_t i = 0; i < PENDING_BUCKETS; i++)
        for (const struct pending *pending = table->buckets[i]; pending; pending = pending->next)
            if (pending->orphaned && !pending->waited)
                return pending;
    return NULL;
}

void pending_set_ready(struct pending_table *table, struct pending *pending,
                       enum percuss_result result)
{
    pending->ready = true;
    pending->result = result;
    pending->previous_ready = table->last_ready;
    *(table->last_ready ? &table->last_ready->next_ready : &table->first_ready) = pending;
    table->last_ready = pending;
}

static void leave_ready_list(struct pending_table *table, struct pending *pending)
{
    struct pending *previous = pending->previous_ready, *next = pending->next_ready;
    *(previous ? &previous->next_ready : &table->first_ready) = next;
    *(next ? &next->previous_ready : &table->last_ready) = previous;
}

void pending_remove(struct pending_table *table, struct pending *pending)
{
    if (pending->ready)
        leave_ready_list(table, pending);
    struct pending **link = bucket_of(table, pending->sequence);
    while (*link != pending)
        link = &(*link)->next;
    *link = pending->next;
    table->count--;
    percuss_reply_free(&pending->reply);
    free(pending);
}

void pending_clear(struct pending_table *table)
{
    for (size_t i = 0; i < PENDING_BUCKETS; i++)
        while (table->buckets[i])
            pending_remove(table, table->buckets[i]);
}
