/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Jobs for a queue, and what goes in and comes out. */
#ifndef PERCUSS_TEST_QUEUED_H
#define PERCUSS_TEST_QUEUED_H

#include "check.h"
#include "daemon/queue.h"
#include "exchange/key_map.h"
#include "exchange/reply_store.h"

/* The queue looks at nothing of a job but how many items it has. */
static inline struct job job_of(size_t items)
{
    return (struct job){.items = items};
}

static const struct digest NOBODY = {0, 0};

static inline struct job job_of_client(uint64_t client)
{
    return (struct job){.items = 1, .owner = {client, 0}};
}

/* All its items, by workers who have been given them. */
static inline void finish(struct queue *queue, struct job *job)
{
    for (size_t i = 1; i < job->items; i++)
        queue_done(queue, job->owner, NULL);
    queue_done(queue, job->owner, job);
}

/* Without anybody who gives way. */
static inline bool put(struct queue *queue, struct job *job)
{
    struct job *displaced;
    bool accepted = queue_put(queue, job, &displaced);
    assert_null(displaced);
    return accepted;
}

/* The next request must be this one. */
static inline void takes(struct queue *queue, const struct job *expected, size_t expected_index)
{
    size_t index = 999;
    assert_ptr_equal(queue_take(queue, &index), expected);
    assert_int_equal(index, expected_index);
}

/* A job is called what its arrival in the test says. */
static inline bool is_called(struct job *job, const struct request_name *name)
{
    return job->items == name->sequence;
}

#endif
