/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/parallel.h"

#include <pthread.h>
#include <stdatomic.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

enum { MOST_THREADS = 64, CHUNK = 16 };
static const long long WATCH_NANOSECONDS = 100000000;

struct parallel {
    const struct parallel_loop *loop;
    atomic_ullong next; /* first item that no thread has taken */
    atomic_bool stopped;
    pthread_mutex_t lock;
    pthread_cond_t finished;
    unsigned running; /* under the lock */
};

struct thread {
    struct parallel *parallel;
    unsigned number;
    atomic_ullong at; /* all its items below are done */
    pthread_t id;
};

static void work_off(struct thread *thread)
{
    struct parallel *parallel = thread->parallel;
    const struct parallel_loop *loop = parallel->loop;
    while (!atomic_load(&parallel->stopped)) {
        uint64_t first = atomic_fetch_add(&parallel->next, CHUNK);
        atomic_store(&thread->at, first);
        if (first >= loop->end)
            return;
        for (uint64_t i = first; i < first + CHUNK && i < loop->end; i++) {
            atomic_store(&thread->at, i);
            if (!loop->work(loop->context, thread->number, i))
                return;
        }
    }
    /* its items are done */
    atomic_store(&thread->at, UINT64_MAX);
}

static void *run(void *argument)
{
    struct thread *thread = argument;
    struct parallel *parallel = thread->parallel;
    if (parallel->loop->nice)
        setpriority(PRIO_PROCESS, (id_t)gettid(), parallel->loop->nice);
    work_off(thread);
    pthread_mutex_lock(&parallel->lock);
    parallel->running--;
    pthread_cond_signal(&parallel->finished);
    pthread_mutex_unlock(&parallel->lock);
    return NULL;
}

/* Items below this are all done. Between taking a chunk and storing its first item the `at` of a
 * thread is an item of its last chunk, which is less: the least counts. */
static uint64_t done_by_all(const struct parallel *parallel, struct thread *threads, unsigned count)
{
    uint64_t least = atomic_load(&parallel->next);
    for (unsigned i = 0; i < count; i++) {
        uint64_t at = atomic_load(&threads[i].at);
        least = at < least ? at : least;
    }
    return least < parallel->loop->end ? least : parallel->loop->end;
}

/* Waits until all threads have ended, and calls the watch meanwhile. */
static void attend(struct parallel *parallel, struct thread *threads, unsigned count)
{
    struct timespec wake;
    clock_gettime(CLOCK_MONOTONIC, &wake);
    pthread_mutex_lock(&parallel->lock);
    while (parallel->running > 0) {
        /* until the next look, or the end of the last thread */
        long long nanoseconds = wake.tv_nsec + WATCH_NANOSECONDS;
        wake.tv_sec += nanoseconds / 1000000000;
        wake.tv_nsec = nanoseconds % 1000000000;
        while (parallel->running > 0 &&
               pthread_cond_timedwait(&parallel->finished, &parallel->lock, &wake) == 0)
            ;
        if (parallel->running == 0)
            break;
        /* without the lock: threads end while the watch is asked */
        pthread_mutex_unlock(&parallel->lock);
        if (!parallel->loop->watch(parallel->loop->context, done_by_all(parallel, threads, count)))
            atomic_store(&parallel->stopped, true);
        pthread_mutex_lock(&parallel->lock);
    }
    pthread_mutex_unlock(&parallel->lock);
}

static unsigned start(struct parallel *parallel, struct thread *threads, unsigned wanted)
{
    unsigned count = 0;
    parallel->running = wanted;
    for (; count < wanted; count++) {
        threads[count].parallel = parallel;
        threads[count].number = count;
        atomic_init(&threads[count].at, parallel->loop->first);
        if (pthread_create(&threads[count].id, NULL, run, &threads[count]) != 0)
            break;
    }
    pthread_mutex_lock(&parallel->lock);
    parallel->running -= wanted - count;
    pthread_mutex_unlock(&parallel->lock);
    return count;
}

uint64_t parallel_run(const struct parallel_loop *loop)
{
    struct parallel parallel = {.loop = loop};
    struct thread threads[MOST_THREADS];
    /* the state that the threads share */
    pthread_condattr_t monotonic;
    atomic_init(&parallel.next, loop->first);
    atomic_init(&parallel.stopped, false);
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&parallel.lock, NULL);
    pthread_cond_init(&parallel.finished, &monotonic);
    pthread_condattr_destroy(&monotonic);
    /* their work */
    unsigned wanted = loop->threads < MOST_THREADS ? loop->threads : MOST_THREADS;
    unsigned count = start(&parallel, threads, wanted);
    attend(&parallel, threads, count);
    for (unsigned i = 0; i < count; i++)
        pthread_join(threads[i].id, NULL);
    pthread_cond_destroy(&parallel.finished);
    pthread_mutex_destroy(&parallel.lock);
    return count == 0 ? loop->first : done_by_all(&parallel, threads, count);
}
