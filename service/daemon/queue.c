/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/queue.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>

struct queue {
    pthread_mutex_t lock;
    pthread_cond_t filled, drained;
    size_t capacity, first, length;
    size_t running; /* items handed out and not yet done */
    bool closed;
    LIST_HEAD(live_jobs, job) live; /* that wait or are being done */
    struct job *jobs[];             /* a ring */
};

struct queue *queue_create(size_t capacity)
{
    struct queue *queue = calloc(1, sizeof *queue + capacity * sizeof(struct job *));
    if (!queue)
        return NULL;
    queue->capacity = capacity;
    LIST_INIT(&queue->live);
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&queue->lock, NULL);
    pthread_cond_init(&queue->filled, NULL);
    pthread_cond_init(&queue->drained, &monotonic);
    pthread_condattr_destroy(&monotonic);
    return queue;
}

void queue_free(struct queue *queue)
{
    if (!queue)
        return;
    pthread_cond_destroy(&queue->drained);
    pthread_cond_destroy(&queue->filled);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}

static void push(struct queue *queue, struct job *job)
{
    queue->jobs[(queue->first + queue->length) % queue->capacity] = job;
    queue->length++;
}

static struct job *pop(struct queue *queue)
{
    struct job *job = queue->jobs[queue->first];
    queue->first = (queue->first + 1) % queue->capacity;
    queue->length--;
    return job;
}

bool queue_put(struct queue *queue, struct job *job)
{
    pthread_mutex_lock(&queue->lock);
    bool accepted = !queue->closed && queue->length < queue->capacity;
    if (accepted) {
        push(queue, job);
        LIST_INSERT_HEAD(&queue->live, job, live);
        if (job->items > 1)
            pthread_cond_broadcast(&queue->filled);
        else
            pthread_cond_signal(&queue->filled);
    }
    pthread_mutex_unlock(&queue->lock);
    return accepted;
}

struct job *queue_take(struct queue *queue, size_t *item)
{
    struct job *job = NULL;
    pthread_mutex_lock(&queue->lock);
    while (queue->length == 0 && !queue->closed)
        pthread_cond_wait(&queue->filled, &queue->lock);
    if (queue->length > 0) {
        job = pop(queue);
        *item = job->next++;
        /* the other items go to the end: others need not wait for all of it */
        if (job->next < job->items)
            push(queue, job);
        queue->running++;
    }
    pthread_mutex_unlock(&queue->lock);
    return job;
}

void queue_done(struct queue *queue, struct job *ended)
{
    pthread_mutex_lock(&queue->lock);
    if (ended)
        LIST_REMOVE(ended, live);
    if (--queue->running == 0 && queue->length == 0)
        pthread_cond_broadcast(&queue->drained);
    pthread_mutex_unlock(&queue->lock);
}

void queue_close(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    queue->closed = true;
    pthread_cond_broadcast(&queue->filled);
    pthread_mutex_unlock(&queue->lock);
}

void queue_cancel(struct queue *queue)
{
    struct job *job;
    queue_close(queue);
    pthread_mutex_lock(&queue->lock);
    LIST_FOREACH(job, &queue->live, live)
    {
        if (job->kind->cancel)
            job->kind->cancel(job);
    }
    pthread_mutex_unlock(&queue->lock);
}

bool queue_drain(struct queue *queue, double seconds)
{
    struct timespec end;
    clock_gettime(CLOCK_MONOTONIC, &end);
    long long nanoseconds = end.tv_nsec + (long long)(seconds * 1e9);
    end.tv_sec += nanoseconds / 1000000000;
    end.tv_nsec = nanoseconds % 1000000000;
    int expired = 0;
    pthread_mutex_lock(&queue->lock);
    while (!expired && (queue->length > 0 || queue->running > 0))
        expired = pthread_cond_timedwait(&queue->drained, &queue->lock, &end);
    bool drained = queue->length == 0 && queue->running == 0;
    pthread_mutex_unlock(&queue->lock);
    return drained;
}

size_t queue_length(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    size_t length = queue->length;
    pthread_mutex_unlock(&queue->lock);
    return length;
}
